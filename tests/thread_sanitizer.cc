// oneTBB is not instrumented: when it sets memory that another thread gave back, the thread sanitizer sees the calls, and not what came
// between them. Linked into every test under that sanitizer.
extern "C" __attribute__((visibility("default"))) const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() { return "called_from_lib:libtbb.so\n"; }
