#!/bin/sh
# slurm.sh: one picture by a Slurm job array: every task renders a share of the samples of each pixel.
#
#     parts=64; scene=room.pbrt; spp=4096; dir=room.parts
#     mkdir -p "$dir"
#     job=$(sbatch --parsable --array=0-$((parts - 1)) slurm.sh "$scene" $spp "$dir")
#     sbatch --dependency=afterok:$job --wrap "asbdpt merge '$dir'/*.part -o room.exr"
#
# A task that is preempted or whose node fails is put into the queue again (--requeue) and goes on from its checkpoint.
# Words after the directory are options of asbdpt render, the same for all tasks: --maxdepth 8 -P select=vertices.
#SBATCH --job-name=asbdpt
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=TERM@60
set -eu
scene=$1 spp=$2 dir=$3
shift 3
i=$SLURM_ARRAY_TASK_ID n=$SLURM_ARRAY_TASK_COUNT
exec "${ASBDPT:-asbdpt}" render "$scene" --spp "$spp" --samples $((spp * i / n)):$((spp * (i + 1) / n)) \
    -j "${SLURM_CPUS_PER_TASK:-1}" -o "$dir/$i.part" --checkpoint "$dir/$i.state" --resume "$dir/$i.state" --quiet "$@"
