"""What `cmake --install` puts where: install_test.py BUILD SOURCE SCRATCH

The build is installed below DESTDIR under a prefix of its own, and the result is moved: programs must find their data beside them, and
examples, man pages and completion must name nothing that is not there."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib
import unittest

BUILD, SOURCE, SCRATCH = (pathlib.Path(name).resolve() for name in sys.argv[1:4])


def texts_in(value):
    """All texts in a document of TOML."""
    if isinstance(value, str):
        return [value]
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else []
    return [text for each in inner for text in texts_in(each)]


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)
        installed = subprocess.run(["cmake", "--install", BUILD, "--prefix", "/opt/menger"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True, env={**os.environ, "DESTDIR": str(SCRATCH / "stage")})
        if installed.returncode != 0:
            raise AssertionError(installed.stdout)
        cls.top = SCRATCH / "moved"
        (SCRATCH / "stage/opt/menger").rename(cls.top)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(SCRATCH)  # a hundred megabytes

    def run_menger(self, *arguments):
        done = subprocess.run([self.top / "bin/menger", *arguments], cwd=SCRATCH, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_everything_is_below_the_prefix(self):
        self.assertEqual(sorted(each.name for each in (SCRATCH / "stage/opt").iterdir()), [])
        self.assertEqual(sorted(each.name for each in (SCRATCH / "stage").iterdir()), ["opt"])

    def test_programs_find_their_data_beside_them(self):
        self.assertIn("Dragon Skin 10", self.run_menger("init", "robot"))
        said = self.run_menger("loop", "robot/robot.toml", "--until", "mesh")
        self.assertIn("the parameters that come with menger", said)
        self.assertIn("dragon_skin_10_1cm.toml", said)

    def test_examples_name_files_that_are_there(self):
        examples = list((self.top / "share/doc/menger/examples").rglob("*.toml"))
        self.assertGreater(len(examples), 20)
        for example in examples:
            for text in texts_in(tomllib.loads(example.read_text(encoding="utf-8"))):
                # Parameters keep the names of files that they were fitted to; those were results, not examples. So is the champion of a
                # search, which menger export writes.
                if text.endswith(".toml") and text != "champion.toml" and example.parent.name != "parameters":
                    self.assertTrue((example.parent / text).is_file(), f"{example}: {text}")

    def test_links_lead_to_files_of_the_installation(self):
        links = [each for each in self.top.rglob("*") if each.is_symlink()]
        self.assertIn("menger-loop", {each.name for each in links}, "the completion of a program is that of menger")
        for each in links:
            self.assertTrue(each.exists(), each)
            self.assertTrue(each.resolve().is_relative_to(self.top), each)

    def test_completion_knows_every_command(self):
        completion = (self.top / "share/bash-completion/completions/menger").read_text(encoding="utf-8")
        listed = completion.split("complete -F _menger menger menger-{")[1].split("}")[0].split(",")
        commands = re.findall(r"^  ([a-z-]+)  ", self.run_menger("--help"), re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(commands))

    @unittest.skipIf(shutil.which("help2man") is None, "help2man is not installed")
    def test_man_pages_keep_commands_on_their_lines(self):
        page = SCRATCH / "menger-init.1"
        subprocess.run(["cmake", f"-DPROGRAM={self.top / 'bin/menger-init'}", f"-DPAGE={page}", f"-DHELP2MAN={shutil.which('help2man')}",
                        "-DEXAMPLES=share/doc/menger/examples", "-P", SOURCE / "cmake/man_page.cmake"], check=True)
        self.assertIn(".nf\nmenger init my_robot \\fB\\-\\-from\\fR crawler\nmenger loop my_robot/robot.toml\n.fi\n", page.read_text(encoding="utf-8"))
        self.assertIn("share/doc/menger/examples", page.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
