"""Runs the examples in the texts of the package, and those of a page of docs/ between ```python and ```."""
import doctest
import pathlib
import re
import sys
import tempfile
import os

import tunica
from tunica import cases, materials, meshes, results, simulation, stages


def main():
    page = pathlib.Path(sys.argv[1]).resolve()
    failed = attempted = 0
    for module in (tunica, materials, results, cases, meshes, simulation, stages):
        outcome = doctest.testmod(module)
        failed, attempted = failed + outcome.failed, attempted + outcome.attempted
    if attempted == 0:
        print("the package has no example")
        return 1
    blocks = re.findall(r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    names = {}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for number, block in enumerate(blocks):
            try:
                exec(compile(block, f"{page.name}, example {number + 1}", "exec"), names)
            except Exception as error:
                print(f"{page.name}, example {number + 1}: {type(error).__name__}: {error}\n{block}")
                failed += 1
        os.chdir("/")
    print(f"{attempted} lines of examples in the package, {len(blocks)} examples in {page.name}, {failed} failed")
    return 1 if failed or not blocks else 0


if __name__ == "__main__":
    sys.exit(main())
