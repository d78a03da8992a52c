"""Finds links and requests of a site that lead to nothing or into the network."""
import html.parser
import os
import urllib.parse

# What a browser loads by itself with a page. Links that a reader follows may lead elsewhere.
LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href", "object": "data"}


class Page(html.parser.HTMLParser):
    """The addresses that a page loads, and those to which it links."""

    def __init__(self):
        super().__init__()
        self.loaded, self.linked = [], []

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag in LOADED and values.get(LOADED[tag]):
            self.loaded.append(values[LOADED[tag]])
        elif tag == "a" and values.get("href"):
            self.linked.append(values["href"])


def faults(site):
    """Returns a sentence for each fault of the pages below a folder."""
    found = []
    exists = {}
    for file in sorted(site.rglob("*.html")):
        page = Page()
        page.feed(file.read_text(encoding="utf-8", errors="replace"))
        found += [f"{file}: loads {address} from the network" for address in page.loaded
                  if urllib.parse.urlsplit(address).netloc]
        for address in page.loaded + page.linked:
            parts = urllib.parse.urlsplit(address)
            if parts.scheme or parts.netloc or not parts.path:
                continue
            target = os.path.normpath(file.parent / urllib.parse.unquote(parts.path))
            if target not in exists:
                exists[target] = os.path.exists(target)
            if not exists[target]:
                found.append(f"{file}: the link {address} leads to nothing")
    for style in site.rglob("*.css"):
        if "url(http" in style.read_text(encoding="utf-8", errors="replace").replace("'", "").replace('"', ""):
            found.append(f"{style}: loads a file from the network")
    return found
