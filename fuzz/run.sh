#!/usr/bin/env bash
# Runs every fuzz target for its share of the time: bash fuzz/run.sh [SECONDS], an hour by default.
# Needs a nightly compiler and cargo-fuzz; no code here is unsafe, so no sanitizer is built in. Ends
# with 1 where something was found; what was found is in fuzz/artifacts, what was run is told at the
# end.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=$(("${1:-3600}" / 5))
bash fuzz/seed.sh
mkdir -p fuzz/target
found=0
told=""
for target in files tables solved expressions quantities; do
    log="fuzz/target/$target.log"
    if cargo +nightly fuzz run --sanitizer none "$target" -- \
        -dict=crates/mechanisms/tests/all/fuzzing/dictionary.txt \
        -max_len=16000 -timeout=60 -rss_limit_mb=4096 \
        -max_total_time="$seconds" -print_final_stats=1 2>&1 | tee "$log"; then
        result="nothing found"
    else
        result="FOUND SOMETHING: see fuzz/artifacts/$target"
        found=1
    fi
    inputs=$(awk '/number_of_executed_units/ { print $2 }' "$log")
    told+="$target: ${inputs:-?} inputs in $seconds s, $result"$'\n'
done
printf '\n%s' "$told"
exit "$found"
