#!/usr/bin/env python3
"""Lays out the pages of the site for Sphinx: the pages of docs/ and of the root in the dialect of MyST, reference pages
from what the program prints, a gallery.

usage: sources.py ROOT TARGET TUNICA [--with-api] [VIEW ...]     VIEW: name=page.html, pages of `tunica view` for the gallery;
                                                                  with --with-api pages of the C++ interface are in api/

Pages are written for GitHub: formulas are $`...`$ and ```math, links lead through the repository. Every page has a place
in CONTENTS, and every link leads to a page or a file; anything else is an error."""
import os
import re
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import reference  # noqa: E402

# The contents, by caption: pages by their path in the repository, or generated ones by their name.
CONTENTS = {
    "Tutorial": ["docs/tutorial/demo.md", "docs/tutorial/own_tube.md", "docs/tutorial/own_patient.md", "docs/tutorial/own_tissue.md", "docs/tutorial/own_study.md"],
    "Coming from": ["docs/coming_from_simvascular.md"],
    "Guides": ["docs/chain.md", "docs/meshing.md", "docs/fibres.md", "docs/prestress.md", "docs/outlets.md", "docs/results.md", "docs/post.md", "docs/measured.md", "docs/motion.md", "docs/view.md",
               "docs/study.md", "docs/follow_up.md", "docs/what_if.md", "docs/identify.md", "docs/fit.md", "docs/dispersed_fibres.md", "docs/python.md"],
    "Look up": ["gallery", "docs/examples.md", "docs/faq.md", "docs/glossary.md", "docs/inputs.md", "reference/index", "api"],
    "Background": ["docs/theory.md", "docs/verification.md", "docs/validation.md", "docs/performance.md"],
    "Project": ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"],
}
HOME = "docs/README.md"


def page_name(path):
    """Of a page in the repository, without its ending: docs/chain.md is `chain`, CHANGELOG.md is `changelog`."""
    if path == HOME:
        return "index"
    stem = path[:-3]
    return stem[5:] if stem.startswith("docs/") else {"README": "about"}.get(stem, stem.lower())


class Site:
    def __init__(self, root, target):
        self.root, self.target, self.errors = Path(root), Path(target), []
        named = [p for pages in CONTENTS.values() for p in pages]
        self.pages = {p: page_name(p) for p in [HOME, *named] if p.endswith(".md")}
        for path in sorted(self.root.glob("docs/**/*.md")):
            if str(path.relative_to(self.root)) not in self.pages:
                self.errors.append(f"{path.relative_to(self.root)}: has no place in CONTENTS of docs/site/sources.py")
        for path in self.pages:
            if not (self.root / path).exists():
                self.errors.append(f"{path}: is in the contents, but does not exist")

    def write(self, name, text):
        file = self.target / f"{name}.md"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def up(self, page):
        return "../" * page.count("/")

    def file_link(self, page, path):
        """A file of the repository as a file of the site; texts with an ending that browsers show."""
        source, name = self.root / path, path if "." in Path(path).name else path + ".txt"
        if path.endswith((".yaml", ".cpp", ".csv")):
            name += ".txt"
        to = self.target / "_extra" / "files" / name
        if source.is_dir():
            for one in sorted(source.iterdir()):
                if one.is_file():
                    self.file_link(page, str(one.relative_to(self.root)))
            files = "".join(f'<li><a href="{n}">{n}</a></li>' for n in sorted(p.name for p in to.with_suffix("").iterdir()))
            to = to.with_suffix("") / "index.html"
            to.write_text(f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{path}</title><h1>{path}</h1><ul>{files}</ul></html>', encoding="utf-8")
        else:
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, to)
        return self.up(page) + str(to.relative_to(self.target / "_extra"))

    def link(self, path, page, picture, text, to):
        if re.match(r"[a-z]+:", to) or to.startswith("#"):
            return f"{picture}[{text}]({to})"
        place, _, anchor = to.partition("#")
        where = os.path.normpath(os.path.join(os.path.dirname(path), place))
        if not (self.root / where).exists():
            self.errors.append(f"{path}: the link to {to} leads nowhere")
            return text
        if where in self.pages:
            return f"[{text}]({self.up(page)}{self.pages[where]}.md{'#' + anchor if anchor else ''})"
        if picture:
            to = self.target / "pictures" / os.path.basename(where)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(self.root / where, to)
            return f"![{text}]({self.up(page)}pictures/{to.name})"
        label = re.sub(r"`([^`]*)`", r"<code>\1</code>", text)
        return f'<a href="{self.file_link(page, where)}">{label}</a>'

    def converted(self, path):
        """A page of the repository in MyST's dialect."""
        page, out, fence = self.pages[path], [], None
        for line in (self.root / path).read_text(encoding="utf-8").splitlines():
            mark = re.match(r"\s*(```+|~~~+)(.*)", line)
            if fence is None and mark:
                fence = mark[1]
                if mark[2].strip() == "math":
                    line = line.replace("math", "{math}", 1)
            elif fence is not None and mark and mark[1].startswith(fence) and not mark[2].strip():
                fence = None
            elif fence is None:
                line = re.sub(r"\$`(.+?)`\$", lambda m: "{math}`" + m[1] + "`", line)
                line = re.sub(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)", lambda m: self.link(path, page, m[1], m[2], m[3]), line)
            out.append(line)
        return "\n".join(out) + "\n"

    def lay_out(self, program, views, with_api):
        for path, page in self.pages.items():
            text = self.converted(path)
            if path == HOME:
                text += "".join(self.toctree(caption, pages) for caption, pages in CONTENTS.items())
            self.write(page, text)
        for name, text in reference.pages(program).items():
            self.write(name, text)
        self.write("gallery", self.gallery(views))
        self.write("api", self.interface(with_api))
        static = self.target / "_static"
        static.mkdir(parents=True, exist_ok=True)
        shutil.copy(Path(__file__).resolve().parent / "site.css", static)

    def interface(self, with_api):
        headers = '<a href="api/index.html">classes and functions</a>' if with_api else "not made (`scripts/site --quick`)"
        library = f'<a href="{self.file_link("api", "examples/library")}">examples/library</a>'
        return ("# C++ and Python\n\n"
                f"The headers of the libraries, with units, shapes and errors: {headers}. Which room may include which is in [](architecture.md); a program "
                f"of its own on the libraries is {library}.\n\nThe Python package: [](python.md).\n")

    @staticmethod
    def toctree(caption, pages):
        lines = [page_name(p) if p.endswith(".md") else p for p in pages]
        return f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "\n".join(lines) + "\n```\n"

    def gallery(self, views):
        """Pages to turn and play, then every picture of the docs with the sentence that stands before it."""
        text = "# Gallery\n\n## To turn and play\n\n"
        if views:
            folder = self.target / "_extra" / "beats"
            folder.mkdir(parents=True, exist_ok=True)
            for name, file in views:
                shutil.copy(file, folder / f"{name}.html")
                text += f'- <a href="beats/{name}.html">{name.replace("_", " ")}</a>: a beat in 3D ([](view.md))\n'
        text += "\n## Pictures\n\n<ul class=\"cards\">\n"
        for path, page in self.pages.items():
            content = (self.root / path).read_text(encoding="utf-8")
            for label, to in re.findall(r"!\[([^\]]*)\]\(([^)\s]+)\)", content):
                name = os.path.basename(to)
                shutil.copy(self.root / os.path.dirname(path) / to, self.target / "_extra" / "files" / name)
                title = re.search(r"^# (.*)", content, re.M)[1]
                text += (f'<li><figure><a href="files/{name}"><img src="files/{name}" alt="{label}" loading="lazy"></a><figcaption>{label}: '
                         f'<a href="{page}.html">{title}</a></figcaption></figure></li>\n')
        return text + "</ul>\n"


def main():
    root, target, program = sys.argv[1:4]
    views = [tuple(v.split("=", 1)) for v in sys.argv[4:] if v != "--with-api"]
    shutil.rmtree(target, ignore_errors=True)
    (Path(target) / "_extra" / "files").mkdir(parents=True)
    site = Site(root, target)
    if not site.errors:
        site.lay_out(program, views, "--with-api" in sys.argv)
    if site.errors:
        sys.exit("\n".join(site.errors))


main()
