#!/usr/bin/env bash
# Copies the seeds of the fuzz targets into fuzz/corpus: every mechanism, batch and table of the
# repository, those that are wrong too.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p fuzz/corpus/files fuzz/corpus/tables fuzz/corpus/solved
for folder in tests/reference examples examples/own-joints crates/mechanisms/tests/broken; do
    for file in "$folder"/*.ron "$folder"/*.csv "$folder"/json_*.json; do
        [ -f "$file" ] || continue
        name="$(basename "$folder")-$(basename "$file")"
        case "$file" in
            *.csv) cp "$file" "fuzz/corpus/tables/$name" ;;
            *) cp "$file" "fuzz/corpus/files/$name" && cp "$file" "fuzz/corpus/solved/$name" ;;
        esac
    done
done
for target in expressions quantities; do
    mkdir -p "fuzz/corpus/$target"
    split --lines=1 --additional-suffix=.txt "crates/mechanisms/tests/all/fuzzing/$target.txt" "fuzz/corpus/$target/"
done
for target in files tables solved expressions quantities; do
    echo "$target: $(find "fuzz/corpus/$target" -type f | wc -l) seeds"
done
