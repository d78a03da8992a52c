"""The files of a folder, for tests that compare what runs leave behind."""
import os


def contents(folder):
    """The bytes of all files of a folder and its folders, by name."""
    files = {}
    for place, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                files[os.path.relpath(path, folder)] = file.read()
    return files
