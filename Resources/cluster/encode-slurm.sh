#!/bin/sh
#SBATCH --job-name=pacini
#SBATCH --cpus-per-task=1
#SBATCH --output=pacini-%A_%a.log
# Encodes a folder of sounds as an array job of Slurm, a shard a task; every node must see the same folders.
#
#   sbatch --array=1-32 encode-slurm.sh SOUNDS CLIPS   options of pacini encode in ENCODE, such as ENCODE='--bands 8'
#
# The array must start at 1. To go on after a time limit, or with another number of tasks, submit it again: what is
# done already is not done again. When all tasks have ended:
#
#   pacini manifest merge CLIPS/run.manifest.*-of-32.json -o CLIPS/run.manifest.json
set -eu
sounds=$1 clips=$2
pacini=${PACINI:-pacini}
mkdir -p "$clips"
exec "$pacini" encode "$sounds" -o "$clips" --format packed -q -j "${SLURM_CPUS_PER_TASK:-1}" ${ENCODE:-} \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --manifest "$clips/run.manifest.json"
