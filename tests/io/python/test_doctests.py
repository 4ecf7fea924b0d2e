"""Every example in a docstring runs as it stands, in an empty folder after ``import viscard``; every public name has one."""
import doctest
import importlib
import inspect
import pathlib
import pkgutil
import re
import types

import pytest

import viscard



class Finder(doctest.DocTestFinder):
    def _from_module(self, module, found):
        return super()._from_module(module, inspect.unwrap(found) if inspect.isroutine(found) else found)


FINDER = Finder(exclude_empty=True)


def remembered(call):
    """The same call in another example gives the same answer, and the file that it wrote: each runs once."""
    answers = {}

    def again(*words, **keywords):
        key = repr((words, keywords))
        if key not in answers:
            found = call(*words, **keywords)
            answers[key] = found, pathlib.Path(found.file).read_bytes() if hasattr(found, "file") else b""
        found, contents = answers[key]
        if contents:
            pathlib.Path(found.file).write_bytes(contents)
        return found

    return again


MODULE = types.SimpleNamespace(**{**vars(viscard), "capture": remembered(viscard.capture),
                                  "cost_of_tests": remembered(viscard.cost_of_tests)})


def all_examples():
    modules = [viscard] + [importlib.import_module(f"viscard.{m.name}")
                           for m in pkgutil.iter_modules(viscard.__path__) if m.name != "_core"]
    return [test for module in modules for test in FINDER.find(module) if test.examples]


@pytest.mark.parametrize("example", all_examples(), ids=lambda test: test.name)
def test_example(example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    example.globs = {"viscard": MODULE}
    lines = []
    doctest.DocTestRunner(verbose=False).run(example, out=lines.append)
    assert not lines, "".join(lines)


def test_every_public_name_has_an_example():
    with_example = {name for test in all_examples() for name in test.name.split(".")}
    assert set(viscard.__all__) <= with_example


def test_public_names_are_all():
    assert all(hasattr(viscard, name) for name in viscard.__all__)
    assert viscard.__all__ == sorted(viscard.__all__, key=str)


def test_the_stubs_name_what_the_compiled_part_has():
    stubs = pathlib.Path("io/python/viscard/_core.pyi").read_text()
    stated = set(re.findall(r"^(?:def|class) (\w+)", stubs, re.M)) | {"version"}
    assert stated == {name for name in dir(viscard._core) if not name.startswith("__")}
