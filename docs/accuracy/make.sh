#!/bin/sh
# Makes what stands in this folder: what accuracy costs in scenes that come with Snell.
#
#     docs/accuracy/make.sh                          about an hour of one core
#     SCENES="cornell S1 S2" docs/accuracy/make.sh   five minutes: what stands here now
#     SIDE=256 PASSES=1024 docs/accuracy/make.sh     some hours
#
# SIDE is the width of the pictures in pixels, PASSES how far each run goes, SEEDS how many runs each variant has. What was
# measured is kept in target/accuracy, so that the command goes on where it was interrupted. Passes and photons are fixed, so
# the errors are the same on every machine; the times are those of one core, and are not.
set -eu
cd "$(dirname "$0")/../.."
: "${SIDE:=32}" "${PASSES:=64}" "${SEEDS:=8}" "${SCENES:=cornell goblet S1 S2 S3 S4}"
cargo build --release
[ -f scenes/bench/blob1m.obj ] || cargo run --release --example bench_meshes
out=docs/accuracy
work=target/accuracy
mkdir -p "$work"
study() { # SCENE HEIGHT METHODS [MORE OPTIONS]
    scene=$1 height=$2 methods=$3
    shift 3
    name=$(basename "$scene" .snell)
    target/release/snell study "$scene" -o "$work/$name.html" --size "${SIDE}x$height" --sweep method="$methods" \
        --sweep spp="$PASSES" --seeds "$SEEDS" --threads 1 --format markdown "$@" > "$work/$name.md"
    cp "$work/$name.svg" "$work/$name.csv" "$out/"
    printf '\n## %s\n\n![%s: error against time](%s.svg)\n\n' "$name" "$name" "$name" >> "$out/README.md"
    cat "$work/$name.md" >> "$out/README.md"
}
sed "s/SIDE/$SIDE/g; s/PASSES/$PASSES/g; s/SEEDS/$SEEDS/g; s/NAMES/$SCENES/g" "$out/head.md" > "$out/README.md"
for one in $SCENES; do
    case $one in
    cornell) study scenes/cornell.snell "$SIDE" pt,ppm,hybrid --sweep photons=5000 ;;
    goblet) study scenes/goblet.snell "$((SIDE * 3 / 4))" pt,ppm,hybrid --sweep photons=20000 ;;
    S1) study scenes/bench/S1.snell "$SIDE" pt,ppm --sweep photons=5000 ;;
    S2) study scenes/bench/S2.snell "$SIDE" pt,ppm,hybrid --sweep photons=5000 ;;
    S3) study scenes/bench/S3.snell "$SIDE" pt,ppm --sweep photons=5000 ;;
    S4) study scenes/bench/S4.snell "$SIDE" pt,ppm,hybrid --sweep photons=20000 ;;
    *) echo "no scene is called $one" >&2; exit 2 ;;
    esac
done
if [ -f "$work/cornell.html" ]; then cp "$work/cornell.html" "$out/"; fi
