"""The scripts of Resources/cluster with the schedulers themselves, on this machine: what they leave must be what one run of
the command leaves, also after they were stopped in the middle.

    check_cluster.py PACINI SOURCE parallel|slurm
"""
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PACINI, SOURCE, SCHEDULER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
SCRIPTS = SOURCE / "Resources/cluster"
SKIPPED = 77
NEEDED = {"parallel": ["parallel"], "slurm": ["slurmctld", "slurmd", "sbatch", "squeue", "scancel", "munged"]}


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, timeout=300, **options)


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*.pacb")}


class Cluster(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="pacini-cluster-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        sounds = self.folder / "sounds"
        sounds.mkdir()
        for sound in sorted((SOURCE / "Resources/demo").glob("*.flac")):
            for copy in range(3):
                shutil.copy(sound, sounds / f"{sound.stem}-{copy}.flac")
        run(PACINI, "encode", "sounds", "-o", "whole", "--format", "packed", "-q", cwd=self.folder)
        self.whole = contents(self.folder / "whole")
        self.assertGreater(len(self.whole), 20)

    def check(self, shards):
        self.assertEqual(contents(self.folder / "clips"), self.whole)
        run(PACINI, "manifest", "check", "clips/run.manifest.json", "-q", cwd=self.folder)


class Parallel(Cluster):
    def encode(self, shards, **options):
        return subprocess.Popen(["sh", str(SCRIPTS / "encode-parallel.sh"), "sounds", "clips", str(shards)],
                                cwd=self.folder, env={**os.environ, "PACINI": str(PACINI)}, **options)

    def test_all_shards_give_what_one_run_gives(self):
        self.assertEqual(self.encode(5).wait(300), 0)
        self.check(5)
        # Again, with another number: nothing is left to do.
        before = {path: path.stat().st_mtime_ns for path in (self.folder / "clips").rglob("*.pacb")}
        self.assertEqual(self.encode(3).wait(300), 0)
        self.assertEqual({path: path.stat().st_mtime_ns for path in before}, before)

    def test_a_run_that_was_killed_goes_on(self):
        first = self.encode(4, start_new_session=True)
        until = time.monotonic() + 60
        while len(list(self.folder.glob("clips/*.pacb"))) < 4 and time.monotonic() < until:
            time.sleep(0.01)
        os.killpg(first.pid, signal.SIGKILL)
        first.wait(60)
        self.assertEqual(self.encode(3).wait(300), 0)
        self.check(3)

    def test_a_file_that_fails_is_said_by_the_exit_code(self):
        (self.folder / "sounds/bad.wav").write_bytes(b"RIFF")
        done = self.encode(2, stderr=subprocess.PIPE)
        self.assertIn(b"bad.wav", done.communicate(timeout=300)[1])
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(contents(self.folder / "clips"), self.whole)


class Slurm(Cluster):
    """A cluster of one node in a folder of its own, without systemd and control groups."""

    def setUp(self):
        super().setUp()
        self.home = Path(tempfile.mkdtemp(prefix="sl"))
        self.addCleanup(shutil.rmtree, self.home, ignore_errors=True)
        home, host = self.home, socket.gethostname().split(".")[0]
        home.chmod(0o755)
        (home / "key").write_bytes(random.Random(1).randbytes(1024))
        (home / "key").chmod(0o400)
        for name in ("state", "spool"):
            (home / name).mkdir()
        ports = []
        for _ in range(2):
            with socket.socket() as free:
                free.bind(("127.0.0.1", 0))
                ports.append(free.getsockname()[1])
        (home / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={home}/munge.socket
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={home}/state
SlurmdSpoolDir={home}/spool
SlurmctldPidFile={home}/slurmctld.pid
SlurmdPidFile={home}/slurmd.pid
SlurmctldLogFile={home}/slurmctld.log
SlurmdLogFile={home}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
MaxArraySize=1000
NodeName={host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=p Nodes={host} Default=YES State=UP
""")
        self.environment = {**os.environ, "SLURM_CONF": str(home / "slurm.conf"), "PACINI": str(PACINI)}
        self.addCleanup(self.stop)
        run("munged", f"--key-file={home}/key", f"--socket={home}/munge.socket", f"--pid-file={home}/munged.pid",
            f"--log-file={home}/munged.log", f"--seed-file={home}/munged.seed", "--force", stderr=subprocess.DEVNULL)
        run("slurmctld", env=self.environment)
        run("slurmd", env=self.environment)
        until = time.monotonic() + 60
        while b"idle" not in subprocess.run(["sinfo", "-h", "-o", "%T"], env=self.environment,
                                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout:
            self.assertLess(time.monotonic(), until, (home / "slurmctld.log").read_text()[-2000:])
            time.sleep(0.2)

    def stop(self):
        for name in ("slurmd", "slurmctld", "munged"):
            try:
                os.kill(int((self.home / f"{name}.pid").read_text()), signal.SIGTERM)
            except (OSError, ValueError):
                pass

    def submit(self, tasks, *options):
        return run("sbatch", "--parsable", f"--array=1-{tasks}", *options, SCRIPTS / "encode-slurm.sh", "sounds", "clips",
                   cwd=self.folder, env=self.environment, stdout=subprocess.PIPE).stdout.decode().split(";")[0].strip()

    def merge(self, tasks):
        run(PACINI, "manifest", "merge",
            *[f"clips/run.manifest.{i}-of-{tasks}.json" for i in range(1, tasks + 1)],
            "-o", "clips/run.manifest.json", "-q", cwd=self.folder)

    def test_an_array_job_gives_what_one_run_gives_also_when_it_was_cancelled(self):
        job = self.submit(4)
        until = time.monotonic() + 120
        while not list(self.folder.glob("clips/*.pacb")) and time.monotonic() < until:
            time.sleep(0.05)
        run("scancel", "--signal=KILL", "--full", job, env=self.environment)
        run("scancel", job, env=self.environment)
        while run("squeue", "-h", env=self.environment, stdout=subprocess.PIPE).stdout and time.monotonic() < until:
            time.sleep(0.2)
        self.submit(3, "--wait")
        self.merge(3)
        self.check(3)


if __name__ == "__main__":
    missing = [name for name in NEEDED[SCHEDULER] if shutil.which(name) is None]
    if SCHEDULER == "slurm" and os.geteuid() != 0:
        missing.append("root")
    if missing:
        print(f"SKIPPED: {', '.join(missing)} missing")
        sys.exit(SKIPPED)
    tests = unittest.defaultTestLoader.loadTestsFromTestCase({"parallel": Parallel, "slurm": Slurm}[SCHEDULER])
    sys.exit(0 if unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful() else 1)
