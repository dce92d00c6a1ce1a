"""Runs the cells of examples/notebooks, shortened, one after the other as Jupyter does: each notebook after the one whose
results it opens. They are made of the scripts in examples/python, and have to be the same still."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(sys.argv[1]).resolve()


def code_of(notebook):
    """What the cells of a notebook are, as one program."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")


def main():
    subprocess.run([sys.executable, str(FOLDER.parent.parent / "scripts" / "notebooks"), "--check"], check=True)
    ran = set()
    with tempfile.TemporaryDirectory() as out:
        for name, arguments, expected in (
            ("laws", [], "kPa around the vessel"),
            ("own_inflow", [f"{out}/own", "40"], "completed"),
            ("finished_run", [f"{out}/own"], "largest velocity"),
            ("tear_sizes", [f"{out}/tears", "228", "2"], "pressure at the inlet"),
        ):
            done = subprocess.run([sys.executable, "-c", code_of(FOLDER / f"{name}.ipynb"), *arguments],
                                  capture_output=True, text=True, env={**os.environ, "MPLBACKEND": "Agg"})
            if done.returncode or expected not in done.stdout:
                print(name, done.returncode, done.stdout, done.stderr, sep="\n")
                return 1
            print(f"{name}: {done.stdout.strip().splitlines()[-1]}")
            ran.add(name)
    left = {file.stem for file in FOLDER.glob("*.ipynb")} - ran
    if left:
        print("not run:", ", ".join(sorted(left)))
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
