#!/usr/bin/env bash
# Copies the seeds of the loader's fuzz target into fuzz/corpus/loader: every mechanism, batch and
# broken file of the repository.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p fuzz/corpus/loader
for folder in tests/reference examples examples/own-joints crates/mechanisms/tests/broken; do
    for file in "$folder"/*.ron; do
        cp "$file" "fuzz/corpus/loader/$(basename "$folder")-$(basename "$file")"
    done
done
echo "$(find fuzz/corpus/loader -type f | wc -l) seeds"
