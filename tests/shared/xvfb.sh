#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# One virtual screen for all window tests of one ctest run; starting one per test takes four times as long.
#   xvfb.sh start DIR         starts Xvfb and notes its display and process under DIR
#   xvfb.sh run DIR CMD...    runs CMD on it; without a started one, on one of its own
#   xvfb.sh stop DIR
# The notes are named after ctest's process (our parent), so that two runs do not meet. Xvfb ends with that process,
# so that a killed run leaves nothing behind. PS_TEST_ON_DISPLAY=1 shows the tests on the screen in DISPLAY instead.
set -eu
action=$1
dir=$2
shift 2
note=$dir/xvfb.$PPID

own_screen() { [[ -n ${PS_TEST_ON_DISPLAY:-} && -n ${DISPLAY:-} ]]; }

# launch OWNER NOTE: writes "DISPLAY PID" to NOTE once the server takes clients. Xvfb finds a free number by itself.
launch() {
  local owner=$1 file=$2 number= tries
  if ! command -v Xvfb >/dev/null; then
    echo "xvfb.sh: Xvfb is not installed; './dev setup' installs it" >&2
    return 1
  fi
  mkdir -p "$dir"
  rm -f "$file"
  setsid Xvfb -displayfd 3 -screen 0 1920x1200x24 -nolisten tcp -noreset +extension GLX \
    3>"$file.display" >/dev/null 2>"$file.log" </dev/null &
  local server=$!
  for ((tries = 0; tries < 300; ++tries)); do
    number=$(cat "$file.display" 2>/dev/null || true)
    [[ -n $number ]] && break
    kill -0 "$server" 2>/dev/null || break
    sleep 0.1
  done
  if [[ -z $number ]]; then
    echo "xvfb.sh: Xvfb did not start:" >&2
    cat "$file.log" >&2
    kill "$server" 2>/dev/null || true
    return 1
  fi
  echo ":$number $server" >"$file"
  rm -f "$file.display"
  (
    setsid tail --pid="$owner" -f /dev/null
    kill "$server" 2>/dev/null
    rm -f "$file" "$file.log"
  ) >/dev/null 2>&1 </dev/null &
}

case $action in
  start)
    own_screen && exit 0
    launch "$PPID" "$note"
    ;;
  run)
    unset WAYLAND_DISPLAY
    own_screen && exec "$@"
    if [[ ! -f $note ]]; then
      note=$dir/xvfb.$$
      launch $$ "$note"
    fi
    read -r DISPLAY _ <"$note"
    export DISPLAY
    exec "$@"
    ;;
  stop)
    [[ -f $note ]] || exit 0
    read -r _ server <"$note"
    kill "$server" 2>/dev/null || true
    rm -f "$note" "$note.log"
    ;;
  *)
    echo "usage: xvfb.sh start|run|stop DIR [COMMAND...]" >&2
    exit 2
    ;;
esac
