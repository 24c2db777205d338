#!/usr/bin/env bash
# Bakes in several processes: bake_processes.sh BAKE MODEL.glb. One, two and four give the same bytes; one that dies ends them all with a
# message and a partial file to go on from. Exits 77 where there is no mpirun.
set -euo pipefail
bake=$(readlink -f "$1")
model=$(readlink -f "$2")

if ! command -v mpirun >/dev/null; then
    echo "skipped: no mpirun"
    exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo "{\"entities\":[{\"name\":\"hall\",\"mesh\":\"$model\",\"StaticPRT\":{}}]}" >hall.json
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

fail()
{
    echo "failed: $*"
    exit 1
}

together() { mpirun --oversubscribe -n "$@"; }

# The process of rank $2 among the children of $1.
process_of_rank()
{
    local id
    for id in $(pgrep -P "$1"); do
        if tr '\0' '\n' <"/proc/$id/environ" | grep -qx "OMPI_COMM_WORLD_RANK=$2"; then
            echo "$id"
        fi
    done
}

same_bytes_from_any_number()
{
    local count few="--set prt.density=0.5 --set prt.rays=64 --set prt.cell_rays=64 --set prt.cell=2 --threads 1"
    # shellcheck disable=SC2086 # words
    "$bake" hall.json $few --output alone.exr
    for count in 1 2 4; do
        # shellcheck disable=SC2086 # words
        together "$count" "$bake" hall.json $few --output "$count.exr"
        cmp alone.exr "$count.exr" || fail "$count processes bake something else"
    done
}

a_death_ends_all_and_keeps_what_is_done()
{
    local many="--set prt.density=2 --set prt.rays=512 --set prt.cell_rays=64 --set prt.cell=2 --threads 1" code=0 kept=0
    # shellcheck disable=SC2086 # words
    mpirun --oversubscribe -n 2 "$bake" hall.json $many --output killed.exr >killed.log 2>&1 &
    local mpirun=$!
    while ((kept < 1000)); do
        sleep 0.05
        kill -0 "$mpirun" || fail "the bake ended before a process was killed: $(cat killed.log)"
        kept=$(stat -c %s killed.exr.partial 2>/dev/null || echo 0)
    done
    kill -KILL "$(process_of_rank "$mpirun" 1)"
    wait "$mpirun" || code=$?
    cat killed.log
    ((code != 0)) || fail "a process died and the exit code is 0"
    [[ ! -e killed.exr ]] || fail "a process died and there is a bake"
    grep -q "rank 1 .*signal 9" killed.log || fail "nobody says which process died"
    (($(stat -c %s killed.exr.partial) >= kept)) || fail "what was done is lost"

    # shellcheck disable=SC2086 # words
    "$bake" hall.json $many --output killed.exr --resume
    # shellcheck disable=SC2086 # words
    "$bake" hall.json $many --output whole.exr
    cmp killed.exr whole.exr || fail "going on gives something else"
    [[ ! -e killed.exr.partial ]] || fail "the partial file stays"
}

# The line that the baker ends with: "... 173 MiB of memory at the peak, 195 MiB estimated".
the_peak_is_within_a_fifth_of_the_estimate()
{
    local peak estimated
    "$bake" hall.json --set prt.density=4 --set prt.rays=64 --set prt.cell_rays=64 --output memory.exr | tee memory.log
    read -r peak estimated < <(sed -nE 's/.* ([0-9]+) MiB of memory at the peak, ([0-9]+) MiB estimated.*/\1 \2/p' memory.log)
    ((10 * peak <= 12 * estimated)) || fail "it takes $peak MiB and said $estimated"
}

one_line_for_all()
{
    local code=0
    together 2 "$bake" no_such.json >refused.log 2>&1 || code=$?
    cat refused.log
    ((code == 2)) || fail "exit code $code for a scene that is not there"
    (($(grep -c "no_such.json: " refused.log) == 1)) || fail "not one line for what is wrong"
}

same_bytes_from_any_number
a_death_ends_all_and_keeps_what_is_done
the_peak_is_within_a_fifth_of_the_estimate
one_line_for_all
