"""Links that lead nowhere: in the guides as they are written, and in the pages that were made of them."""
import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

IN_MARKDOWN = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.M | re.S)


def _elsewhere(link: str) -> bool:
    parts = urlsplit(link)
    return bool(parts.scheme or parts.netloc) or not parts.path


def broken_in_markdown(files: list) -> list:
    """["page: link"] of relative links whose file is not there."""
    found = []
    for file in files:
        for link in IN_MARKDOWN.findall(CODE.sub("", file.read_text(encoding="utf-8"))):
            if not _elsewhere(link) and not (file.parent / unquote(urlsplit(link).path)).exists():
                found.append(f"{file}: {link}")
    return found


class _Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.anchors = [], set()

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name in ("id", "name") and value:
                self.anchors.add(value)


def _read(file: Path) -> _Page:
    page = _Page()
    page.feed(file.read_text(encoding="utf-8"))
    return page


def broken_in_site(site: Path, skip: str = "api") -> list:
    """["page: link"] of links within the site whose file or place in it is not there. Pages below `skip` are only linked to."""
    pages = {file: _read(file) for file in sorted(site.rglob("*.html")) if file.relative_to(site).parts[0] != skip}
    found = []
    for file, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or file.name == "404.html":  # the page of errors has links from the server's root
                continue
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if target.is_dir():
                target = target / "index.html"
            known = pages.get(target)
            if not target.exists() or (known and parts.fragment and unquote(parts.fragment) not in known.anchors):
                found.append(f"{file.relative_to(site)}: {link}")
    return found
