#!/usr/bin/env bash
# Tests how the steps of the scripts in .ci report a step that fails: steps_test.sh FILE, where FILE is .ci/steps.
told=$(bash -c '
  source "$1"
  good() { echo "$1 ran" >&2; }
  half_good() { false; echo half; return 3; }
  step build good build
  step "test it" after build half_good
  step report after build after "test it" good report
  step last good last' steps "$1" 2>&1)
status=$?
failed=0
expect() { [[ $2 == $3 ]] || { printf '%s: %s\n' "$1" "$2"; failed=1; }; }
expect "exit status" "$status" 1
expect "what ran" "$(grep -c ' ran$' <<<"$told")" 2
expect "table" "$(tail -n 4 <<<"$told" | sed -E 's/ +[0-9]+ s +[0-9]+ s +/: /')" \
  $'build: passed\ntest it: FAILED\nreport: not run\nlast: passed'
told=$(bash -c '
  source "$1"
  slow() { sleep 0.2; echo slow ran; return 2; }
  start beside slow
  step now echo now ran
  finish beside
  start none after beside true
  start fine after now true
  finish none
  finish fine' steps "$1" 2>&1)
expect "exit status of steps beside each other" $? 1
expect "order of their output" "$(grep ' ran$' <<<"$told" | grep -v = | tr '\n' ,)" "now ran,slow ran,"
expect "their table" "$(tail -n 4 <<<"$told" | sed -E 's/ +[0-9]+ s +[0-9]+ s +/: /')" \
  $'now: passed\nbeside: FAILED\nnone: not run\nfine: passed'
bash -c 'source "$1"; step one true; step two after one true' steps "$1" >/dev/null
expect "exit status of what passed" $? 0
exit $failed
