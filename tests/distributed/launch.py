"""Runs the program under mpirun, for the tests of this folder."""
import os
import shutil
import subprocess
import tempfile

# The exit code by which ctest knows a skipped test.
SKIPPED = 77
# Of the launcher, which removes the folder at its end: not one that it shares with launchers of other tests.
SESSIONS = tempfile.TemporaryDirectory(prefix="ranks")


def command(ranks, *words):
    """The words for so many ranks; the program by itself if there is one."""
    if ranks == 1:
        return list(words)
    return [shutil.which("mpirun"), "-n", str(ranks), "--oversubscribe", "--bind-to", "none", *words]


def environment():
    """mpirun refuses root otherwise. Ranks that wait must leave the processor to others."""
    return {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
            "OMPI_MCA_orte_tmpdir_base": SESSIONS.name}


def run(ranks, *words, **more):
    return subprocess.run(command(ranks, *words), capture_output=True, text=True, timeout=300, check=False,
                          env={**environment(), **more})


def start(ranks, *words):
    return subprocess.Popen(command(ranks, *words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env=environment(), start_new_session=True)
