#!/bin/sh
# pomona_accuracy measures past a broken scene, and refuses outputs before any work.
# usage: accuracy_cli_test.sh POMONA POMONA_ACCURACY
pomona=$1 accuracy=$2
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "accuracy_cli_test: $1"
  cat "$folder/said"
  exit 1
}

mkdir "$folder/scenes"
for scene in boxes planes; do
  "$pomona" render "$scene" --size 64x48 -o "$folder/scenes/$scene" >"$folder/said" 2>&1 || fail "no scene to measure"
done
: >"$folder/scenes/boxes/im1.png"
"$accuracy" "$folder/scenes" --methods fast --json "$folder/out.json" >"$folder/table" 2>"$folder/said" &&
  fail "a broken scene did not fail the run"
grep -q "error: boxes: .*boxes/im1.png" "$folder/said" || fail "the broken scene was not named"
grep -q '"scenes": \["planes"\]' "$folder/out.json" || fail "the other scene was not measured"

"$accuracy" "$folder/scenes" --methods fast --json "$folder/absent/out.json" >"$folder/table" 2>"$folder/said" &&
  fail "an output in no folder was accepted"
grep -q planes "$folder/said" && fail "an output in no folder was noticed after the work"
exit 0
