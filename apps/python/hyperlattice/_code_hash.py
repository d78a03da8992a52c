"""A hash of what a function computes: its code, and the values that the code uses.

A run is resumed only with functions of the same hash. Equal hashes mean the same code in the same version of Python,
with the same defaults, the same values in closures and the same global variables that the code names. A value that
cannot be compared gives a hash that no other one equals, so that such a run is not resumed.
"""
from __future__ import annotations

import functools
import hashlib
import pickle
import sys
import sysconfig
import types
import uuid
from typing import Any

import numpy as np


def hash_of(function: Any) -> str:
    """The hash, as 32 hexadecimal digits."""
    walk = _Walk()
    walk.add("python", sys.version_info[:2])
    try:
        walk.visit(function)
    except RecursionError:
        walk.add_difference()
    return walk.digest.hexdigest()


_INSTALLED = tuple({sysconfig.get_path(name) + "/" for name in ("stdlib", "platstdlib", "purelib", "platlib")}
                   | {folder + "/" for folder in sys.path if folder.endswith(("site-packages", "dist-packages"))})


class _Walk:
    def __init__(self) -> None:
        self.digest = hashlib.blake2b(digest_size=16)
        self.seen: dict[int, tuple[int, Any]] = {}  # by id: its number; and the object, so that it lives

    def add(self, *words: Any) -> None:
        self.digest.update(repr(words).encode())

    def add_difference(self) -> None:
        """Makes the hash differ from all others."""
        self.add("unlike any other", uuid.uuid4().hex)

    def visit(self, value: Any) -> None:
        if value is None or isinstance(value, (bool, int, float, complex, str, bytes, type(...))):
            self.add("value", type(value).__name__, value)
            return
        if id(value) in self.seen:
            self.add("again", self.seen[id(value)][0])
            return
        self.seen[id(value)] = (len(self.seen), value)
        self._visit_object(value)

    def _visit_object(self, value: Any) -> None:
        if isinstance(value, types.FunctionType):
            self._function(value)
        elif isinstance(value, types.MethodType):
            self._list("method", [value.__func__, value.__self__])
        elif isinstance(value, types.CodeType):
            self._code(value)
        elif isinstance(value, functools.partial):
            self._list("partial", [value.func, value.args, value.keywords])
        elif isinstance(value, types.ModuleType):
            self.add("module", value.__name__, str(getattr(value, "__version__", "")))
        elif isinstance(value, (types.BuiltinFunctionType, np.ufunc)):
            self.add("built in", getattr(value, "__module__", None), value.__name__)
        elif isinstance(value, type):
            self._class(value)
        elif isinstance(value, np.ndarray) and value.dtype != object:
            self.add("array", value.shape, value.dtype.str)
            self.digest.update(np.ascontiguousarray(value).tobytes())
        elif isinstance(value, (tuple, list)):
            self._list(type(value).__name__, value)
        elif isinstance(value, dict):
            self._list("dict", [part for item in value.items() for part in item])
        elif isinstance(value, (set, frozenset)):
            self.add("set", sorted(hash_of(entry) for entry in value))
        else:
            self._other(value)

    def _list(self, kind: str, values: Any) -> None:
        self.add(kind, len(values))
        for value in values:
            self.visit(value)

    def _code(self, code: types.CodeType) -> None:
        self.add("code", code.co_code.hex(), code.co_names, code.co_varnames, code.co_freevars, code.co_flags)
        self._list("constants", code.co_consts)

    def _function(self, function: types.FunctionType) -> None:
        self.add("function", function.__qualname__)
        if _is_installed(function.__module__):
            self.add("of", function.__module__, _version_of(function.__module__))
            return
        self.visit(function.__code__)
        self.visit(function.__defaults__)
        self.visit(function.__kwdefaults__)
        for cell in function.__closure__ or ():
            try:
                self.visit(cell.cell_contents)
            except ValueError:  # the variable has no value yet
                self.add("empty")
        for name in sorted(_names_in(function.__code__)):
            if name in function.__globals__:
                self.add("global", name)
                self.visit(function.__globals__[name])

    def _class(self, value: type) -> None:
        self.add("class", value.__module__, value.__qualname__)
        if _is_installed(value.__module__):
            self.add("of", _version_of(value.__module__))
            return
        for base in value.__bases__:
            self.visit(base)
        for name, member in sorted(vars(value).items()):
            if isinstance(member, (staticmethod, classmethod)):
                member = member.__func__
            if isinstance(member, property):
                member = (member.fget, member.fset)
            if name not in ("__dict__", "__weakref__", "__doc__", "__module__"):
                self.add("member", name)
                self.visit(member)

    def _other(self, value: Any) -> None:
        """An object of any class: its class, and what pickle or its attributes say of it."""
        self.visit(type(value))
        if not _is_installed(type(value).__module__) and hasattr(value, "__dict__"):
            self.visit(vars(value))
            return
        try:
            self.digest.update(pickle.dumps(value, protocol=4))
        except Exception:  # what pickle raises depends on the object
            self.add_difference()


def _names_in(code: types.CodeType) -> set[str]:
    """The names that a code uses, with those of the functions inside it."""
    names = set(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            names |= _names_in(constant)
    return names


def _is_installed(module: str | None) -> bool:
    """Whether a module is part of Python or installed, so that its version says what it does."""
    root = (module or "").partition(".")[0]
    if root == "__main__":
        return False
    if root in sys.builtin_module_names or root == __package__:
        return True
    file = getattr(sys.modules.get(root), "__file__", None) or ""
    return file.startswith(_INSTALLED)


def _version_of(module: str | None) -> str:
    return str(getattr(sys.modules.get((module or "").partition(".")[0]), "__version__", sys.version))
