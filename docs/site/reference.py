"""Reference pages from what the program prints: keys of its files from `tunica schema`, commands from their help."""
import re
import subprocess

KINDS = {"case": "The case file", "mesh": "The file of tunica mesh", "fibres": "The file of tunica fibres", "study": "The file of tunica study",
         "follow-up": "The file of tunica follow-up", "what-if": "The file of tunica what-if", "identify": "The file of tunica identify",
         "fit": "The file of tunica fit", "material": "The file of tunica material", "report": "The file of tunica report", "image": "The file of tunica synthesise", "flow-image": "The file of tunica synthesise --flow", "measure": "The file of tunica measure",
         "motion-image": "The file of tunica synthesise --motion", "motion": "The file of tunica motion"}


def printed(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def anchor(key):
    return re.sub(r"[^a-z0-9]+", "-", key.lower()).strip("-")


def linked_rows(text, kind, page_of):
    """Rows of the tables of keys: the name of a key that has a section of its own leads there."""
    at, out = "", []
    for line in text.splitlines():
        heading = re.match(r"#+ `(.+)`$", line)
        row = re.match(r"\| `([^`]+)` \|", line)
        if heading:
            at = heading[1]
            out.append(f"({kind}-{anchor(at)})=")
            out.append("#" * min(5, 1 + len(at.split("."))) + f" `{at}`")
            continue
        if row:
            key = f"{at}.{row[1]}" if at else row[1]
            if key in page_of:
                line = line.replace(f"`{row[1]}`", f"[`{row[1]}`]({kind}-{anchor(key)})", 1)
        out.append(line)
    return "\n".join(out) + "\n"


def schema_pages(program, kind):
    """One page for each key of the first level, and one with these keys."""
    text = printed(program, "schema", *([] if kind == "case" else [f"--{kind}"]))
    head, *sections = re.split(r"(?m)^(?=## `)", text)
    names = [re.match(r"#+ `(.+)`", s)[1] for s in sections]
    page_of = {n: f"{kind}_{n.split('.')[0].strip('<>')}" for n in names}
    pages = {}
    for name, section in zip(names, sections):
        pages[page_of[name]] = pages.get(page_of[name], "") + section
    out = {f"reference/{page}": linked_rows(body, kind, page_of) for page, body in pages.items()}
    head = re.sub(r"^# .*", f"# {KINDS[kind]}", head)
    out[f"reference/{kind}"] = linked_rows(head, kind, page_of) + "\n```{toctree}\n:hidden:\n\n" + "\n".join(pages) + "\n```\n"
    return out


def commands_page(program):
    text = "# Commands\n\nWhat `tunica --help` and the help of each command print.\n\n"
    overview = printed(program, "--help")
    text += f"```text\n{overview}```\n"
    for name in re.findall(r"(?m)^  ([a-z]+) {2,}\S", overview[overview.index("Subcommands"):]):
        text += f"\n## tunica {name}\n\n```text\n{printed(program, name, '--help')}```\n"
    return text


def pages(program):
    """Text by the name of the page."""
    out = {}
    for kind in KINDS:
        out.update(schema_pages(program, kind))
    out["reference/commands"] = commands_page(program)
    index = ["commands", *KINDS]
    out["reference/index"] = ("# Reference\n\nMade from the program itself: its commands, and every key of its files with unit, range and default.\n\n"
                              + "".join(f"- [](./{name}.md)\n" for name in index) + "\n```{toctree}\n:hidden:\n\n" + "\n".join(index) + "\n```\n")
    return out
