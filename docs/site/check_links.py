#!/usr/bin/env python3
"""Holds every link, picture and script of the HTML pages in a folder against the files that are there, and every anchor
against the page that it leads into. Prints what leads nowhere; exit code 1 then.

usage: check_links.py FOLDER

Pages of the C++ interface (api/) are Doxygen's own; links into them are checked, those between them are not."""
import os
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if value and (name == "id" or (name == "name" and tag == "a")):
                self.ids.add(value)
            elif value and name in ("href", "src"):
                self.links.append(value)


def main():
    root = Path(sys.argv[1]).resolve()
    names = [p for p in root.rglob("*.html") if p.relative_to(root).parts[0] not in ("api", "beats")]
    pages, broken, checked = {}, [], 0

    def page_of(file):
        if file not in pages:
            pages[file] = Page(file.read_text(encoding="utf-8"))
        return pages[file]

    for file in names:
        for link in page_of(file).links:
            parts = urlsplit(link)
            if parts.scheme in ("http", "https", "mailto", "data"):
                continue
            checked += 1
            place = file if not parts.path else Path(os.path.normpath(file.parent / unquote(parts.path)))
            if place.is_dir():
                place /= "index.html"
            if not place.is_file() or root not in place.parents:
                broken.append(f"{file.relative_to(root)}: {link} leads nowhere")
            elif parts.fragment and place.suffix == ".html" and unquote(parts.fragment) not in page_of(place).ids:
                broken.append(f"{file.relative_to(root)}: {link}: the page has no such anchor")
    print("\n".join(broken + [f"{len(names)} pages, {checked} links, {len(broken)} broken"]))
    sys.exit(1 if broken or not checked else 0)


main()
