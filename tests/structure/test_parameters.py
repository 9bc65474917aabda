"""Parameters are read once, into a struct that says what they are (core/registry/members.h); inside, none is asked for by a string."""
import re

from repository import LEAVES, ROOT, code_files, module_of

READ = re.compile(r'(?:\.|->)(?:real|integer|boolean|choice|rgb)\(\s*"\w+"\s*\)')
#: Of whichever entry's values (core/registry/find_value.h): what only those ask for that compare entries with each other.
FIND = re.compile(r'find_value<[^<>]+>\([^()]+,\s*"\w+"\s*\)')
COMPARES = ("study", *LEAVES)


def sources():
    for path in code_files():
        if path.endswith((".cpp", ".h")) and not re.search(r"_(test|fuzz)\.cpp$", path) and not path.startswith("tests/"):
            yield path, (ROOT / path).read_text()


def reads(text, pattern):
    """Line number and read of each, comments left out."""
    bare = re.sub(r"//.*", "", text)
    return [(bare.count("\n", 0, found.start()) + 1, found.group()) for found in pattern.finditer(bare)]


def test_Parameters_InsideModules_AreMembersOfAStruct():
    assert [(path, *read) for path, text in sources() for read in reads(text, READ)] == []


def test_ParameterOfAnyEntry_IsFoundByNameOnlyWhereEntriesAreCompared():
    assert [(path, *read) for path, text in sources() if module_of(path) not in COMPARES for read in reads(text, FIND)] == []


def test_Pattern_OfAKnownRead_Matches():
    text = 'f();\nconst double k = values.real("k");  // values.real("x")\nvalues->choice( "storage" );\nfind_value<double>(v, "a");'
    assert reads(text, READ) == [(2, '.real("k")'), (3, '->choice( "storage" )')]
    assert reads(text, FIND) == [(4, 'find_value<double>(v, "a")')]
