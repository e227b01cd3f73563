#!/bin/sh
# Makes what stands in this folder: what accuracy costs in scenes that come with Snell.
#
#     docs/accuracy/make.sh
#
# Some ten minutes on a quiet core. What was measured is kept in target/accuracy, so that the command goes on where it was
# interrupted. Passes and photons are fixed, so the errors are the same on every machine; the times are not.
set -eu
cd "$(dirname "$0")/../.."
cargo build --release
out=docs/accuracy
work=target/accuracy
mkdir -p "$work"
study() { # SCENE
    name=$(basename "$1" .snell)
    target/release/snell study "$1" -o "$work/$name.html" --size 48x48 --sweep method=pt,ppm --sweep photons=5000 \
        --sweep spp=128 --clock cpu --threads 1 --format markdown > "$work/$name.md"
    cp "$work/$name.svg" "$work/$name.csv" "$out/"
    printf '\n## %s\n\n![%s: error against time](%s.svg)\n\n' "$name" "$name" "$name" >> "$out/README.md"
    cat "$work/$name.md" >> "$out/README.md"
}
cp "$out/head.md" "$out/README.md"
study scenes/cornell.snell
study scenes/bench/S1.snell
cp "$work/cornell.html" "$out/"
