#!/bin/sh
# The set of pictures that shows what the renderer can do: PROGRAM FOLDER.
set -eu
program=$1
folder=$2
here=$(dirname "$0")
mkdir -p "$folder"

take() {
  name=$1
  shift
  "$program" render --size 1440x900 --out "$folder/$name.png" "$@"
}

near="--eye 0.05,-0.42,0.26 --target 0.62,0.02,0"

take opening --scene eight_ball
take aim --scene eight_ball --aim 1.2 --preset high
take break --scene break_shot --at 0.5 --eye -0.5,-0.55,0.45 --target 0.55,0.05,0 --preset high
take touching --scene eight_ball --preset very_high \
  --eye 0.44,-0.13,0.11 --target 0.66,0.0,0.02
take pocket --scene "$here/pocket.toml" --at 0.46 --preset very_high \
  --eye 0.82,0.16,0.30 --target 1.27,0.64,-0.02
take room --scene eight_ball --eye -3.4,-2.2,0.9 --target 0.4,0.3,0.2
take birds_eye --scene break_shot --at 0.5 --from above
for shadows in off soft maps volumes; do
  take "shadows_$shadows" --scene break_shot --at 0.5 $near --preset high --options "shadows=$shadows"
done
take anaglyph --scene break_shot --at 0.5 $near --options stereo=middle
take lowest --scene break_shot --at 0.5 --preset very_low
take highest --scene break_shot --at 0.5 --preset very_high
take marks --scene break_shot --at 0.5 $near --options marks=on
take vectors --scene break_shot --at 0.35 $near --vectors
