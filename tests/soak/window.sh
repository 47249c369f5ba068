#!/bin/sh
# Games in a real window for hours, in real time, with sound and a simulated hand: on a virtual
# display, into a sink of PulseAudio that takes sound at the pace of time and plays it to nobody.
#
#   tests/soak/window.sh PROGRAM MINUTES FOLDER
#
# Needs xvfb, xdotool, pulseaudio and libasound2-plugins. Writes FOLDER/use.csv, a line every ten
# seconds, and checks at the end that nothing has grown, that the program ends in order, and that
# every recording computes again to the bit.
set -eu
program=$(realpath "$1") minutes=$2
here=$(dirname "$(realpath "$0")")
mkdir -p "$3"
cd "$3"
folder=$(pwd)
export HOME="$folder" XDG_DATA_HOME="$folder/data" XDG_CONFIG_HOME="$folder/config"
export XDG_RUNTIME_DIR="$folder/run" LIBGL_ALWAYS_SOFTWARE=1 DISPLAY=:88
mkdir -p "$XDG_RUNTIME_DIR"
chmod 700 "$XDG_RUNTIME_DIR"

Xvfb $DISPLAY -screen 0 1280x720x24 -nolisten tcp -noreset >xvfb.log 2>&1 &
xvfb=$!
pulseaudio -n --daemonize=no --exit-idle-time=-1 --log-target=file:pulse.log \
  -L module-native-protocol-unix -L "module-null-sink sink_name=paced" &
pulse=$!
game=
# Whatever was begun ends with this script.
trap 'kill $game $pulse $xvfb 2>/dev/null || true' EXIT
sleep 2

"$program" play --scene "$here/watched.toml" >game.out 2>game.log &
game=$!
echo "seconds,memory_kib,threads,handles" >use.csv
end=$(($(date +%s) + minutes * 60))
begin=$(date +%s)
while [ "$(date +%s)" -lt $end ]; do
  sleep 10
  kill -0 $game || { echo "the game ended by itself"; tail -3 game.log; exit 1; }
  # A game that is over begins again; in one that goes on nobody listens to this key.
  xdotool key Return
  memory=$(awk '/^VmRSS/ { print $2 }' /proc/$game/status)
  threads=$(ls /proc/$game/task | wc -l)
  handles=$(ls /proc/$game/fd | wc -l)
  echo "$(($(date +%s) - begin)),$memory,$threads,$handles" >>use.csv
done
kill -TERM $game
wait $game || { echo "the game did not end in order"; exit 1; }

games=0
for file in "$XDG_DATA_HOME"/hapticbillard/recordings/*.jsonl; do
  "$program" replay --verify "$file" >/dev/null || { echo "$file differs"; exit 1; }
  games=$((games + 1))
done
[ $games -gt 0 ] || { echo "nothing was recorded"; exit 1; }
echo "recordings that compute again to the bit: $games"
# Means over the second and the last fifth: where one game follows another, there is a thread more
# or less for a moment.
awk -F, 'NR > 1 { n++; m[n] = $2; t[n] = $3; h[n] = $4 }
  END {
    k = int(n / 5); if (k < 1) { print "too short to say what grows"; exit 0 }
    for (i = 1; i <= k; i++) {
      a += m[k + i] / k; b += m[n - k + i] / k
      ta += t[k + i] / k; tb += t[n - k + i] / k
      ha += h[k + i] / k; hb += h[n - k + i] / k
    }
    printf "early and late: %d and %d KiB, %.1f and %.1f threads, %.1f and %.1f handles\n", \
      a, b, ta, tb, ha, hb
    exit (b > 1.05 * a + 2048 || tb > ta + 0.5 || hb > ha + 0.5)
  }' use.csv
