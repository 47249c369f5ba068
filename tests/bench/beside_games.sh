#!/bin/sh
# Pictures a second in a window while a game is played, beside other billiards games on the same
# machine, in turn: PROGRAM [SECONDS [ROUNDS]]. All draw 1440 x 900 pixels on the processor.
#
# apt-get install billard-gl foobillardplus xvfb xdotool libgl1-mesa-dri
#
# Every program is asked by Mesa itself how many pictures there were in each second; the first
# seconds are left out, and the median is printed. FooBillard++ plays against itself with its room,
# its best balls and reflections; BillardGL, which has no room and no computer player, shows its
# opening view and plays a break, at its best. This program plays against itself; a picture that
# would be the same as the last one is not drawn, so seconds in which nothing moves count against it.
set -eu
program=$(realpath "$1")
seconds=${2:-30}
rounds=${3:-3}
here=$(dirname "$(realpath "$0")")
folder=$(mktemp -d)
export DISPLAY=:83 HOME="$folder" USER=player LOGNAME=player SDL_AUDIODRIVER=dummy LC_ALL=C
export XDG_CONFIG_HOME="$folder/config" XDG_DATA_HOME="$folder/data"
export GALLIUM_HUD=fps GALLIUM_HUD_VISIBLE=false GALLIUM_HUD_PERIOD=1
Xvfb $DISPLAY -screen 0 1440x900x24 -nolisten tcp >/dev/null 2>&1 &
server=$!
game=
trap 'kill $server $game 2>/dev/null || true; rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
sleep 1
kill -0 $server 2>/dev/null || { echo "the display $DISPLAY is taken" >&2; exit 1; }

# Runs a game for so long; what is done to it meanwhile comes from a function.
watch() {
  name=$1 play=$2
  shift 2
  export GALLIUM_HUD_DUMP_DIR="$folder/$name"
  rm -rf "$GALLIUM_HUD_DUMP_DIR"
  mkdir -p "$GALLIUM_HUD_DUMP_DIR"
  (cd "$folder" && exec timeout -k 3 $((seconds + 15)) "$@" >/dev/null 2>&1) &
  game=$!
  $play
  wait $game || true
  game=
  tail -n +16 "$GALLIUM_HUD_DUMP_DIR/fps" | sort -n >"$folder/sorted"
  [ -s "$folder/sorted" ] || { echo "$name: no pictures" >&2; exit 1; }
  median=$(awk '{ v[NR] = $1 } END { printf "%.1f", v[int((NR + 1) / 2)] }' "$folder/sorted")
  echo "$name: $median" >&2
  echo "$name $median"
}

nothing() { :; }

click() {
  xdotool mousemove "$1" "$2"
  sleep 0.3
  xdotool mousedown 1
  sleep 0.2
  xdotool mouseup 1
  sleep 2
}

# Its picture over the game goes with the first key: from above, and back.
foobillard() {
  sleep 9
  xdotool key F2
  sleep 2
  xdotool key F2
}

# English, when it starts first; then training, eight-ball.
billardgl() {
  sleep 4
  window=$(xdotool search --name BillardGL | head -1)
  xdotool windowsize "$window" 1440 900 windowmove "$window" 0 0 windowfocus "$window"
  sleep 1
  click 720 450
  click 493 418
  click 580 418
  sleep 3
  xdotool key space
  sleep $((seconds / 2))
  xdotool keydown space
  sleep 1
  xdotool keyup space
}

# The scene without a window, in one.
duel() {
  cat "$here/../../config/scenes/eight_ball_headless.toml"
  printf '\n\n[camera]\n\n[renderer]\nwidth = 1440\nheight = 900\n\n[input]\nprofile = "default"\n'
}

settings() {
  mkdir -p "$XDG_CONFIG_HOME/hapticbillard"
  {
    echo '[picture]'
    echo 'frame_limit = "off"'
    [ "$1" = medium ] || printf 'triangles = 320\ntexture = 64\nenvironment = "off"\ncloth_detail = false\nsmooth = "off"\n'
  } >"$XDG_CONFIG_HOME/hapticbillard/settings.toml"
}

printf '1\n1\n1\n11\n0.400000\n0\n0\n640\n16\n0\n1\n3\n901\n0\n1\n2\n0\n0.500000\n0.500000\nName%%1\nName%%2\nName\n' >"$folder/.BillardGL.conf.v7"
duel >"$folder/duel.toml"
for _ in $(seq "$rounds"); do
  watch billardgl billardgl /usr/games/billard-gl -windowed -t 1 -tt 1 -at 1 -g 11
  settings low
  watch low nothing "$program" play --scene "$folder/duel.toml" --no-record
  watch foobillard foobillard /usr/games/foobillardplus --geometry 1440x900 --8ball --p1 ai --p2 ai \
    --balldetail high --cuberef on --usesound off
  settings medium
  watch medium nothing "$program" play --scene "$folder/duel.toml" --no-record
done >"$folder/all"
cat "$folder/all"
awk '{ sum[$1] += $2; n[$1]++ } END {
  printf "medium / FooBillard++: %.2f\n", sum["medium"] / sum["foobillard"]
  printf "low / BillardGL: %.2f\n", sum["low"] / sum["billardgl"]
}' "$folder/all"
