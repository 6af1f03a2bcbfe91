#!/bin/sh
# Holds the accuracy against the accepted figures on the first scenes there are: $POMONA_DATASETS, else the folders named.
# usage: accuracy_guard.sh POMONA_ACCURACY ACCEPTED_JSON FOLDER...
measure=$1 accepted=$2
shift 2
for folder in ${POMONA_DATASETS:+"$POMONA_DATASETS"} "$@"; do
  if [ -d "$folder" ]; then
    echo "scenes: $folder"
    exec "$measure" "$folder" --guard "$accepted"
  fi
done
echo "datasets absent: skipped (set POMONA_DATASETS to a folder of Middlebury-layout scenes, or run scripts/get_samples)"
exit 77
