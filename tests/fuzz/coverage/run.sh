#!/bin/sh
# Fuzzes each target in turn and prints what came of it. `MINUTES=30 ./run.sh scenes worlds` runs
# these two for half an hour each; without names it is all of them, ten minutes each.
#
# New inputs gather in work/, what fails in artifacts/. Exits with 1 if anything fails.
set -u
cd "$(dirname "$0")" || exit 2
minutes=${MINUTES:-10}
targets=${*:-$(ls bin | sed 's/\.rs$//')}
${CARGO:-cargo} build --release --locked || exit 2
built=target/x86_64-unknown-linux-gnu/release
mkdir -p artifacts
failed=0
# The last number behind a word in a log.
last() { grep -ao "$1 *[0-9]*" "$2" | tail -n 1 | tr -dc '0-9'; }
row() { printf '| %-17s | %12s | %8s | %8s | %8s | %s |\n' "$@"; }
row target executions edges features 'memory' 'failures'
row --- ---: ---: ---: ---: ---
for target in $targets; do
  mkdir -p "work/$target"
  log="work/$target.log"
  dictionary="dictionaries/$target.dict"
  # A time limit per input [s], and one of memory [MB]; single allocations have their own.
  "$built/$target" "work/$target" "corpus/$target" -max_total_time=$((60 * minutes)) \
    -timeout=10 -rss_limit_mb=1024 -max_len=16384 -print_final_stats=1 \
    -artifact_prefix="artifacts/$target-" \
    $([ -f "$dictionary" ] && echo "-dict=$dictionary") >"$log" 2>&1 || failed=1
  found=$(grep -a 'Test unit written to' "$log" | grep -vc slow-unit)
  row "$target" "$(last 'stat::number_of_executed_units:' "$log")" "$(last ' cov:' "$log")" \
    "$(last ' ft:' "$log")" "$(last 'stat::peak_rss_mb:' "$log") MB" "$found"
done
exit $failed
