#!/bin/sh
# cluster.sh: the recipes of doc/cluster, run for real: parts by make, by GNU parallel, and by a Slurm of one machine,
# in which a part is stopped and put into the queue again. Each must give the bytes of the whole picture.
#   sh test/run/cluster.sh PROGRAM
# What is not installed, or cannot be started here, is skipped with a line.
. test/run/expect.sh
work=$dir recipes=$top/doc/cluster scene=scenes/veach-ajar.pbrt # without the blanks that may be in $top
ln -s "$scenes" scenes
export ASBDPT="$program"
trap 'stop_slurm; rm -rf "$dir"' EXIT
trap 'exit 1' INT TERM

same() { # NAME FILE
    cmp -s whole.pfm "$2" && echo "cluster: $1: the bytes of the whole picture" ||
        fault "$1: the picture is not that of one render"
}

# ---- Slurm: a controller, a node and the daemon that they trust each other by, all in the work directory ----
stop_slurm() {
    for daemon in slurmd ctld munge; do
        [ -f "$work/$daemon.pid" ] && kill "$(cat "$work/$daemon.pid")" 2>/dev/null
    done
    sleep 1
}

start_slurm() {
    for tool in munged slurmctld slurmd sbatch; do
        command -v $tool >/dev/null || { echo "skipped: Slurm's recipe (no $tool)"; return 1; }
    done
    [ "$(id -u)" = 0 ] || { echo "skipped: Slurm's recipe (slurmd wants root)"; return 1; }
    host=$(uname -n | sed 's/[.].*//') socket=$work/munge.socket
    mkdir -p "$work/state" "$work/spool"
    chmod 711 "$work"
    export SLURM_CONF="$work/slurm.conf"
    # a controller and a node on this machine
    cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$work/munge.socket
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/ctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/ctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
    dd if=/dev/urandom of="$work/munge.key" bs=1024 count=1 2>/dev/null
    chmod 600 "$work/munge.key"
    munged --key-file="$work/munge.key" --socket="$socket" --pid-file="$work/munge.pid" \
        --log-file="$work/munge.log" --seed-file="$work/munge.seed" --force 2>/dev/null && slurmctld -c && slurmd
    for second in 1 2 3 4 5 6 7 8 9 10; do
        sleep 1
        sinfo -h -o %t 2>/dev/null | grep -q idle && return 0
    done
    echo "skipped: Slurm's recipe (it does not start here)"
    return 1
}

run_slurm() {
    mkdir -p "$work/slurm"
    job=$(sbatch --parsable --array=0-3 "$recipes/slurm.sh" "$scene" 48 "$work/slurm" --res 64x36 --interval 1)
    sbatch --parsable "--dependency=afterok:$job" --wrap "'$ASBDPT' merge slurm/*.part -o slurm.pfm" >/dev/null
    sleep 2
    scontrol requeue "${job}_1" || fault "part 1 had ended before it could be stopped"
    second=0
    while [ -n "$(squeue -h)" ] && [ $second -lt 300 ]; do # a part that was put back waits two minutes
        sleep 1
        second=$((second + 1))
    done
    same "Slurm, part 1 stopped and put back" slurm.pfm
}

"$ASBDPT" render "$scene" --res 64x36 --spp 48 -o whole.pfm --quiet || exit 1
make -s -f "$recipes/Makefile" -j2 SCENE="$scene" SPP=48 PARTS=5 OUT=make.pfm "ASBDPT=$ASBDPT" \
    OPTIONS="--res 64x36" >/dev/null 2>&1
same make make.pfm
if parallel --version 2>/dev/null | grep -q GNU; then
    sed 's/-j 1 /-j 1 --res 64x36 /' "$recipes/parallel.sh" >parallel.sh
    sh parallel.sh "$scene" 48 5 "the parts" parallel.pfm -j2 >/dev/null 2>&1
    same "GNU parallel" parallel.pfm
else
    echo "skipped: GNU parallel's recipe (not installed)"
fi
start_slurm && run_slurm
exit $((failures > 0))
