# Sphinx: how the pages that sources.py has laid out become a site. Formulas are set by KaTeX while the site is built, so
# that pages need no script for them and a formula that cannot be set ends the build.
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

from docutils import nodes

here = Path(__file__).resolve().parent
project = "tunica"
author = "the tunica developers"
copyright = "GPL-3.0-or-later"
version = release = os.environ.get("TUNICA_VERSION", "")
extensions = ["myst_parser"]
myst_heading_anchors = 5
myst_url_schemes = ("http", "https", "mailto")
suppress_warnings = ["myst.header"]  # the reference of the case file has headings by the depth of a key
html_theme = "furo"
html_title = f"tunica {version}".strip()
source = os.environ["TUNICA_SITE_SOURCE"]  # where sources.py has laid out the pages
html_static_path = [f"{source}/_static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_extra_path = [f"{source}/_extra"]
html_show_sphinx = False
html_copy_source = False
smartquotes = False  # texts are as they are written
highlight_language = "none"
# Results of the search have summaries where pages can be fetched, which files opened from a disk cannot.
html_js_files = [(None, {"body": "DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = location.protocol !== 'file:';"})]

KATEX = [Path("/usr/share/javascript/katex"), Path("/usr/share/nodejs/katex/dist")]


class Katex:
    """A process of node that sets one formula a line."""

    def __init__(self):
        self.process = None

    def __call__(self, formula, display):
        if self.process is None:
            self.process = subprocess.Popen(["node", str(here / "katex_lines.js")], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8")
        self.process.stdin.write(json.dumps({"formula": formula, "display": display}) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError("KaTeX has ended: is the Debian package `katex` installed?")
        return json.loads(line)


set_formula = Katex()


def visit_formula(display):
    def visit(translator, node):
        result = set_formula(node.astext(), display)
        if "error" in result:
            raise RuntimeError(f"{translator.builder.current_docname}: formula `{node.astext()}`: {result['error']}")
        tag, kind = ("div", 'class="math display" tabindex="0"') if display else ("span", 'class="math"')
        translator.body.append(f'<{tag} {kind}>{result["html"]}</{tag}>')
        raise nodes.SkipNode
    return visit


def copy_katex(app):
    source = next(p for p in KATEX if (p / "katex.min.css").exists())
    target = Path(app.outdir) / "_static" / "katex"
    shutil.copytree(source, target, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.js", "*.mjs", "contrib", "katex.css"))


def mend_theme(app):
    """Debian's furo fetches a style from the root of the server and has a script that browsers take for no module."""
    static = Path(app.outdir) / "_static"
    style, script = static / "styles" / "furo.css", static / "scripts" / "furo.js"
    text = style.read_text(encoding="utf-8")
    normal = re.search(r"@import url\(/javascript/(\S+?)\);", text)
    if normal:
        style.write_text(text.replace(normal[0], Path("/usr/share/javascript", normal[1]).read_text(encoding="utf-8")), encoding="utf-8")
    text = script.read_text(encoding="utf-8")
    part = re.match(r'import Gumshoe from "\./(\S+)";', text)
    if part:
        module = (static / "scripts" / part[1]).read_text(encoding="utf-8")
        script.write_text(text.replace(part[0], module), encoding="utf-8")


def make_accessible(app, page, template, context, doctree):
    """Captions of the contents are headings, and a heading has a level; what scrolls can be reached by the keyboard."""
    if "furo_navigation_tree" in context:
        context["furo_navigation_tree"] = context["furo_navigation_tree"].replace('role="heading"', 'role="heading" aria-level="2"')
    if "body" in context:
        body = context["body"].replace('<div class="highlight"><pre>', '<div class="highlight"><pre tabindex="0">')
        context["body"] = body.replace('<div class="table-wrapper', '<div tabindex="0" class="table-wrapper')


def finish(app, error):
    if error is None:
        copy_katex(app)
        mend_theme(app)


def setup(app):
    app.add_html_math_renderer("katex", (visit_formula(False), None), (visit_formula(True), None))
    app.connect("html-page-context", make_accessible, priority=900)
    app.connect("build-finished", finish)


html_math_renderer = "katex"
