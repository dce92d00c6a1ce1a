"""Runs the scripts of examples/python, shortened, as a user runs them: each after the one whose results it opens."""
import pathlib
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(sys.argv[1]).resolve()


def main():
    with tempfile.TemporaryDirectory() as out:
        for script, arguments, expected in (
            ("own_inflow.py", [f"{out}/own", "40"], "completed"),
            ("finished_run.py", [f"{out}/own"], "largest velocity"),
            ("tear_sizes.py", [f"{out}/tears", "228", "2"], "pressure at the inlet"),
        ):
            done = subprocess.run([sys.executable, str(FOLDER / script), *arguments], capture_output=True, text=True)
            if done.returncode or expected not in done.stdout:
                print(script, done.returncode, done.stdout, done.stderr, sep="\n")
                return 1
            print(f"{script}: {done.stdout.strip().splitlines()[-1]}")
    left = {file.name for file in FOLDER.glob("*.py")} - {"own_inflow.py", "finished_run.py", "tear_sizes.py"}
    if left:
        print("not run:", ", ".join(sorted(left)))
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
