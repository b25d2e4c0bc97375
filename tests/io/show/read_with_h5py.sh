#!/bin/sh
# Small shows of every kind, read by Debian's h5py alone: gray, colour, one pixel; and a proof that the reader can fail.
set -e
write_sample=$1
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$write_sample" "$folder/gray.h5" 3 300 130 1 2
"$write_sample" "$folder/rgb.h5" 2 257 65 3 1
"$write_sample" "$folder/dot.h5" 1 1 1 1 1
/usr/bin/python3 "$here/read_with_h5py.py" "$folder/gray.h5" "$folder/rgb.h5" "$folder/dot.h5"

for name in asset projector/0/image/kind projector/0/slot/trigger_s lens/drive_a shutter/left_s pose/objects cue/frame; do
  cp "$folder/gray.h5" "$folder/broken.h5"
  /usr/bin/python3 -c "import h5py, sys; del h5py.File(sys.argv[1], 'r+')[sys.argv[2]]" "$folder/broken.h5" "$name"
  if /usr/bin/python3 "$here/read_with_h5py.py" "$folder/broken.h5" 2>/dev/null; then
    echo "a show without $name passed" >&2
    exit 1
  fi
done
