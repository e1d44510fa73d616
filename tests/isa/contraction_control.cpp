// What the check for fused multiply-adds must find: compiled for the same processor, with contraction allowed.
double contracted(double a, double b, double c);
double contracted(double a, double b, double c) { return a * b + c; }
