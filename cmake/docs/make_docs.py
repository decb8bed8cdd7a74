#!/usr/bin/env python3
"""Makes a site of all texts of the repository with MkDocs, or checks their links.

make_docs.py FOLDER          writes FOLDER/source, the texts with what they link to, and FOLDER/site
make_docs.py --texts FOLDER  writes the texts with what they link to into FOLDER, without MkDocs
make_docs.py --check         only checks that every link between the texts leads to a file

A link to a folder leads to its README. Ends with 1 and a list of the links that lead nowhere.
"""

import pathlib
import re
import shutil
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["cmake", "evolution", "fem", "io", "materials", "meshes", "paper", "tests", "voxel"]
LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s#]*)(#[^)\s]*)?\)")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def texts():
    found = list(TOP.glob("*.md"))
    for folder in FOLDERS:
        found += (TOP / folder).rglob("*.md")
    return sorted(found)


def heading_anchor(heading):
    """The anchor of a heading as GitHub makes it, which the extension toc of MkDocs makes alike."""
    words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip()).lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def anchors(text):
    return {heading_anchor(match) for match in re.findall(r"^#+ (.*)$", FENCE.sub("", text), re.MULTILINE)}


class Site:
    def __init__(self, source):
        self.source = source
        self.wrong = []

    def copied(self, file):
        if self.source is None:
            return
        target = self.source / file.relative_to(TOP)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, target)

    def link(self, text, match):
        """The link for the site. Links of other sites stay; those to files of the repository bring the file along."""
        shown, target, anchor = match[1], match[2], match[3] or ""
        if "://" in target or target.startswith("mailto:"):
            return match[0]
        file = (text.parent / target).resolve() if target else text
        if file.is_dir():
            readme = file / "README.md"
            if not readme.exists():
                return shown[1:-1]
            target, file = target.rstrip("/") + "/README.md", readme
        if not file.is_file():
            self.wrong.append(f"{text.relative_to(TOP)}: {target}: there is no such file")
            return match[0]
        if file.suffix == ".md":
            if anchor and anchor[1:] not in anchors(file.read_text()):
                self.wrong.append(f"{text.relative_to(TOP)}: {target}{anchor}: there is no such heading")
        else:
            self.copied(file)
        return f"{shown}({target}{anchor})"

    def add(self, text):
        whole = text.read_text()
        fences = FENCE.findall(whole)
        parts = FENCE.split(whole)
        changed = [LINK.sub(lambda match: self.link(text, match), part) for part in parts]
        joined = changed[0] + "".join(fence + part for fence, part in zip(fences, changed[1:]))
        if self.source is not None:
            target = self.source / text.relative_to(TOP)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(joined)


def write_texts(source):
    """Writes all texts with what they link to into a folder, which it empties first; into none, only checks them."""
    if source is not None and source.exists():
        shutil.rmtree(source)
    site = Site(source)
    for text in texts():
        site.add(text)
    if site.wrong:
        sys.exit("\n".join(site.wrong))


def add_scripts(folder):
    """Adds what Debian's theme asks for under other names than it has, or not at all: without them menus do not open."""
    jquery = folder / "jquery-3.6.0.min.js"
    if not jquery.exists():
        shutil.copyfile(next(folder.glob("jquery-*.min.js")), jquery)
    (folder / "theme_extra.js").touch()


def make_site(folder):
    write_texts(folder / "source")
    configuration = (TOP / "cmake/docs/mkdocs.yml").read_text()
    (folder / "mkdocs.yml").write_text(configuration + f"docs_dir: {folder / 'source'}\nsite_dir: {folder / 'site'}\n")
    subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--config-file", folder / "mkdocs.yml"], check=True)
    add_scripts(folder / "site/js")


def main():
    match sys.argv[1:]:
        case ["--check"]:
            write_texts(None)
        case ["--texts", folder]:
            write_texts(pathlib.Path(folder).resolve())
        case [folder] if not folder.startswith("-"):
            make_site(pathlib.Path(folder).resolve())
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main()
