"""The texts of the repository as others get them: docs_site_test.py SOURCE SCRATCH

./run package takes the texts along: what they link to must be there. ./run docs makes pages that must open without a network.
The latter is skipped where MkDocs is not installed."""

import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

SOURCE, SCRATCH = (pathlib.Path(name).resolve() for name in sys.argv[1:3])


def make(*arguments):
    subprocess.run([sys.executable, "-B", SOURCE / "cmake/docs/make_docs.py", *arguments], check=True)


class Needs(html.parser.HTMLParser):
    """What a page loads."""

    def __init__(self, page):
        super().__init__()
        self.files = []
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        if tag in ("script", "img", "link") and named.get("rel") != "canonical":
            self.files += [named[key] for key in ("src", "href") if named.get(key)]


class Docs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)

    def test_texts_bring_along_what_they_link_to(self):
        make("--texts", SCRATCH / "texts")
        texts = list((SCRATCH / "texts").rglob("*.md"))
        self.assertTrue((SCRATCH / "texts/paper/guide/tutorial.md").is_file())
        for text in texts:
            whole = re.sub(r"^```.*?^```", "", text.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
            for target in re.findall(r"\]\(([^)\s#:]+)[^)\s:]*\)", whole):
                self.assertTrue((text.parent / target).exists(), f"{text}: {target}")

    @unittest.skipIf(shutil.which("mkdocs") is None, "MkDocs is not installed")
    def test_pages_load_nothing_that_is_not_beside_them(self):
        make(SCRATCH / "docs")
        pages = [page for page in (SCRATCH / "docs/site").rglob("*.html") if page.name != "404.html"]  # which only web servers show
        self.assertGreater(len(pages), 10)
        for page in pages:
            for file in Needs(page).files:
                self.assertTrue((page.parent / file.split("?")[0]).is_file(), f"{page}: {file}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
