#!/bin/sh
# Encodes a folder of sounds with GNU parallel, a shard a job; lines of hosts in NODES spread it over machines that see
# the same folders. What is done already is not done again; what was stopped goes on.
#
#   sh encode-parallel.sh SOUNDS CLIPS [SHARDS]        options of pacini encode in ENCODE, such as ENCODE='--bands 8'
#
# GNU parallel: O. Tange, "GNU Parallel - The Command-Line Power Tool", 2011.
set -eu
[ $# -ge 2 ] || { sed -n '2,6p' "$0" >&2; exit 2; }
sounds=$1 clips=$2 shards=${3:-$(nproc)}
pacini=${PACINI:-pacini}
mkdir -p "$clips"
# One thread a job: the jobs are what runs at once. A job that failed does not stop the others.
code=0
seq "$shards" | parallel --will-cite ${NODES:+--sshloginfile "$NODES" --workdir .} --joblog "$clips/run.jobs.log" \
    "$pacini" encode "$sounds" -o "$clips" --format packed -q -j 1 ${ENCODE:-} \
    --shard "{}/$shards" --manifest "$clips/run.manifest.json" || code=$?
"$pacini" manifest merge "$clips"/run.manifest.*-of-"$shards".json -o "$clips/run.manifest.json" || code=$?
"$pacini" manifest check "$clips/run.manifest.json" || code=$?
exit $code
