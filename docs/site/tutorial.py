#!/usr/bin/env python3
"""Files and commands of the tutorial's pages, so that these stay true.

usage: tutorial.py write PAGES FOLDER             leaves the files that the pages ask to be saved there
       tutorial.py try PAGES FOLDER TUNICA        and does the commands that take seconds, as a reader would
       tutorial.py messages PAGE ROOT             holds the messages that PAGE explains against those of the sources

A block whose first line is `# name.yaml`, or that the text before asks to be saved as `name`, is a file."""
import re
import subprocess
import sys
from pathlib import Path

QUICK = ("tunica check ", "tunica material ", "tunica fit ", "tunica study study.yaml --dry-run")


def pages(folder):
    return [p.read_text(encoding="utf-8") for p in sorted(Path(folder).glob("*.md"))]


def write(texts, folder):
    folder.mkdir(parents=True, exist_ok=True)
    names = []
    for text in texts:
        for before, body in re.findall(r"([^\n]*)\n\n```(?:yaml|text)\n(.*?)```", text, re.S):
            named = re.match(r"# (\S+\.yaml)\n", body) or re.search(r"save as `(\S+\.csv)`", before)
            if named:
                (folder / named[1]).write_text(body, encoding="utf-8")
                names.append(named[1])
    if not names:
        sys.exit("the pages have no files")
    return names


def commands(texts):
    """Lines of shell blocks, without comments, whose files exist."""
    for text in texts:
        for body in re.findall(r"```sh\n(.*?)```", text, re.S):
            yield from (line.split("#")[0].strip() for line in body.splitlines())


def try_all(texts, folder, program):
    names, done = write(texts, folder), 0
    for line in commands(texts):
        words = line.split()
        if not line.startswith(QUICK) or not any(w in names for w in words):
            continue
        result = subprocess.run([program, *words[1:]], cwd=folder, capture_output=True, text=True)
        print(f"{line}: exit code {result.returncode}")
        if result.returncode != 0:
            sys.exit(result.stdout + result.stderr)
        done += 1
    if done < 4:
        sys.exit(f"only {done} commands were found")


def messages(page, root):
    """Headings in backquotes are messages; what stands between `…` has to be in a text of the program."""
    sources = "\n".join(p.read_text(encoding="utf-8") for folder in ("src", "app") for p in sorted(Path(root, folder).rglob("*.[ch]pp")))
    sources = re.sub(r'"\s*\n\s*"', "", sources).replace('\\"', '"')
    missing, count = [], 0
    for message in re.findall(r"(?m)^### `+(.*?)`+$", Path(page).read_text(encoding="utf-8")):
        for part in (p.strip() for p in message.split("…")):
            count += 1
            if part not in sources:
                missing.append(f"no message of the program has: {part}")
    print("\n".join(missing + [f"{count} parts of messages, {len(missing)} not found"]))
    sys.exit(1 if missing or not count else 0)


def main():
    what, first, second = sys.argv[1:4]
    if what == "write":
        write(pages(first), Path(second))
    elif what == "try":
        try_all(pages(first), Path(second), sys.argv[4])
    elif what == "messages":
        messages(first, second)
    else:
        sys.exit(__doc__)


main()
