"""Writes viscard/_options.py: the keywords of functions, from what `viscard help COMMAND --json` prints.

write_options.py VISCARD _options.py
"""
import json
import subprocess
import sys

# Commands whose options are keywords of a function.
FUNCTIONS = [("fit", "FitOptions"), ("fit", "JointOptions", ["joint"]),  # of the overload that states joint=True
             ("predict", "PredictOptions")]
TYPES = {"flag": "bool", "text": "Optional[str]", "file": "OptionalPath", "whole number": "Optional[int]",
         "number": "Optional[float]", "quantity": "Quantity"}
LISTS = {"text": "Texts", "file": "Texts", "number": "Union[float, Sequence[float], None]"}


def keyword(option):
    name = option["name"].replace("-", "_")
    return "from_" if name == "from" else name


# Files that may be tables of arrays as well.
TABLES = ("history", "against")


def annotation(option):
    if option["name"] in TABLES:
        return "OptionalTable"
    return (LISTS if option["is_list"] else TYPES)[option["type"]]


def described(option):
    """One keyword in a docstring."""
    choices = f" One of: {', '.join(option['choices'])}." if option["choices"] else ""
    initial = f" Default: {option['default']}." if option["default"] else ""
    return f"{keyword(option)} : {annotation(option)}\n    {option['description'].rstrip('.')}.{choices}{initial}"


def written(command, name, without=()):
    words = [sys.argv[1], "help", command, "--json"]
    options = [one for one in json.loads(subprocess.run(words, check=True, capture_output=True).stdout)["options"]
               if one["is_keyword"] and one["name"] not in without]
    document = "\n".join(described(one) for one in options)
    return "\n".join([f"class {name}(TypedDict, total=False):", f"    {json.dumps(document)}",
                      *[f"    {keyword(one)}: {annotation(one)}" for one in options], "", ""])


with open(sys.argv[2], "w", encoding="utf-8") as file:
    file.write('"""Keywords of the functions that do what a command does; written by the build from its options."""\n\n'
               "from typing import Optional, Sequence, TypedDict, Union\n\n"
               "from ._types import OptionalPath, OptionalTable, Quantity, Texts\n\n\n")
    file.write("\n".join(written(*one) for one in FUNCTIONS))
