#!/usr/bin/env bash
# tools/isa-aarch64.sh    whether an AArch64 processor would give the same bits: compiles what decides an
#                         answer with a cross compiler, runs it in an emulator, and compares its answers with
#                         those of this machine (tests/isa)
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly NATIVE=$ROOT/build/dev
readonly CROSS=$ROOT/build/isa-aarch64
readonly TRIPLE=aarch64-linux-gnu

step "Building and running the reference"
cmake --preset dev
cmake --build --preset dev --target isa_write_inputs isa_digest_reference
ctest --preset dev -R '^isa_(write_inputs|reference)$'

step "Building for AArch64"
cmake -S tests/isa/aarch64 -B "$CROSS" -G Ninja -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
    -DCMAKE_C_COMPILER="$TRIPLE-gcc" -DCMAKE_CXX_COMPILER="$TRIPLE-g++" \
    -DRAYWISE_ISA_EMULATOR="qemu-aarch64;-L;/usr/$TRIPLE" \
    -DRAYWISE_ISA_INPUTS="$NATIVE/tests/isa/inputs.bin" -DRAYWISE_ISA_REFERENCE="$NATIVE/tests/isa/reference.txt"
cmake --build "$CROSS"

step "Running it in the emulator"
ctest --test-dir "$CROSS" --output-on-failure
