#!/usr/bin/env bash
# Tests of code that runs on many threads, under ThreadSanitizer: scripts/thread_sanitizer.sh [TEST ...] (preset `tsan`).
# oneTBB hands work from thread to thread; unless it is built with the sanitizer too, every such hand-over looks like a race.
# So Debian's own source of oneTBB is built once, into build/tsan-tbb. Tests of ray casting are left out: Embree, which is not
# built with the sanitizer, waits for its tasks in code of its own, and its use of the stack looks like a race. Wants dpkg-dev.
set -euo pipefail
cd "$(dirname "$0")/.."
tests=("$@")
[ $# != 0 ] || tests=(vertex_stream_test batch_test deep_opacity_test voxel_test classic_hard_test sleep_test strand_interaction_test
  clumping_test moving_test rasterise_test lut_check_test)
tbb=$PWD/build/tsan-tbb
if ! ls "$tbb"/build/*/libtbb.so.12 >/dev/null 2>&1; then
  mkdir -p "$tbb/parts" "$tbb/lists/partial"
  sed 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$tbb/parts/source.sources"
  apt=(apt-get -qq -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$tbb/parts" -o "Dir::State::Lists=$tbb/lists")
  (cd "$tbb" && "${apt[@]}" update && "${apt[@]}" source onetbb)
  cmake -G Ninja -S "$tbb"/onetbb-*/ -B "$tbb/build" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS=-fsanitize=thread -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON >/dev/null
  ninja --quiet -C "$tbb/build" tbb
fi
scripts/build.sh tsan "${tests[@]}"
LD_LIBRARY_PATH=$(dirname "$(ls "$tbb"/build/*/libtbb.so.12)")
export LD_LIBRARY_PATH TSAN_OPTIONS=ignore_noninstrumented_modules=1
ctest --preset tsan -R "^($(IFS='|'; echo "${tests[*]}"))\$"
