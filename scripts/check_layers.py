#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every module includes only what its CMakeLists.txt allows, and that the allowed
edges follow the order of the layers (SEMSLAM_MODULES in the top CMakeLists.txt).

  check_layers.py [ROOT]        one line for each violation; exit code 1 if there is any
  check_layers.py --self-test   builds small trees with and without violations and checks itself
"""
import pathlib
import re
import sys
import tempfile

HEAVY = re.compile(r'^(pcl/|ceres/|vtk|embree\d*/|GL/|GLFW/|EGL/|imgui|openni2?/|OpenNI\.h|Driver/OniDriverAPI\.h)', re.I)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
SUFFIXES = ('.h', '.hpp', '.cc', '.cpp')


class Module:
    def __init__(self, name, public, private):
        self.name, self.public, self.private = name, public, private


def cmake_text(path):
    return re.sub(r'#.*', '', path.read_text(encoding='utf-8'))


def read_layers(root):
    match = re.search(r'set\s*\(\s*SEMSLAM_MODULES\s+([^)]*)\)', cmake_text(root / 'CMakeLists.txt'))
    if not match:
        sys.exit(f'{root}/CMakeLists.txt: no set(SEMSLAM_MODULES ...)')
    return match.group(1).split()


def read_module(path):
    """The module that src/NAME/CMakeLists.txt declares, or None."""
    match = re.search(r'semslam_add_module\s*\(([^)]*)\)', cmake_text(path))
    if not match:
        return None
    name, *words = match.group(1).split()
    lists = {'SOURCES': [], 'DEPENDS': [], 'PRIVATE_DEPENDS': []}
    current = None
    for word in words:
        if word in lists:
            current = lists[word]
        elif current is not None:
            current.append(word)
    modules = [[d.removeprefix('semslam::') for d in lists[key] if d.startswith('semslam::')]
               for key in ('DEPENDS', 'PRIVATE_DEPENDS')]
    return Module(name, *modules)


def reach(modules, names):
    """`names` and all that they offer on through their public dependencies."""
    found, waiting = set(), list(names)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += modules[name].public if name in modules else []
    return found


def check_order(layers, modules):
    for module in modules.values():
        where = f'src/{module.name}/CMakeLists.txt'
        if module.name not in layers:
            yield f'{where}: {module.name} is not in SEMSLAM_MODULES'
            continue
        for other in module.public + module.private:
            if other not in layers:
                yield f'{where}: semslam::{other} is not in SEMSLAM_MODULES'
            elif layers.index(other) >= layers.index(module.name):
                yield f'{where}: {module.name} must not depend on {other}: it stands above it'


def check_include(path, where, module, allowed, layers, quote, target):
    is_public = path.startswith('include/')
    if path.endswith(('.h', '.hpp')) and HEAVY.match(target):
        yield f'{where}: {target} belongs in .cc files only'
    parts = target.split('/')
    if target.startswith('semslam/'):
        if quote == '<':
            yield f'{where}: include own headers with quotes: {target}'
        if len(parts) > 2 and parts[1] != module and parts[1] not in allowed:
            yield f'{where}: module {module} does not depend on {parts[1]} ({target})'
    elif quote == '"':
        if '..' in parts:
            yield f'{where}: no relative paths: {target}'
        elif is_public:
            yield f'{where}: a public header includes the private {target}'
        elif parts[0] in layers and parts[0] != module:
            yield f'{where}: {target} is private to module {parts[0]}'


def check_files(root, layers, modules):
    for folder in ('include/semslam', 'src'):
        for file in sorted((root / folder).rglob('*')):
            if file.suffix not in SUFFIXES:
                continue
            path = file.relative_to(root).as_posix()
            name = file.relative_to(root / folder).parts[0]
            if name not in modules:
                yield f'{path}: no src/{name}/CMakeLists.txt with semslam_add_module'
                continue
            module = modules[name]
            direct = module.public + ([] if folder.startswith('include') else module.private)
            allowed = reach(modules, direct)
            text = file.read_text(encoding='utf-8')
            for match in INCLUDE.finditer(text):
                line = text.count('\n', 0, match.start(1)) + 1
                yield from check_include(
                    path, f'{path}:{line}', name, allowed, layers, *match.groups())


def check(root):
    layers = read_layers(root)
    modules = {}
    for path in sorted((root / 'src').glob('*/CMakeLists.txt')):
        module = read_module(path)
        if module:
            modules[module.name] = module
    return [*check_order(layers, modules), *check_files(root, layers, modules)]


# --- Self-test -----------------------------------------------------------------------------------

SOUND = {
    'CMakeLists.txt': '# set(SEMSLAM_MODULES wrong)\nset(SEMSLAM_MODULES\n  low mid\n  high)\n',
    'src/low/CMakeLists.txt': 'semslam_add_module(low SOURCES low.cc DEPENDS Threads::Threads)',
    'src/low/low.cc': '#include "semslam/low/low.h"\n#include "low/detail.h"\n#include <pcl/x.h>\n',
    'src/low/detail.h': '#include <vector>\n',
    'include/semslam/low/low.h': '#include <Eigen/Core>\n',
    'src/mid/CMakeLists.txt': 'semslam_add_module(mid SOURCES mid.cc\n  DEPENDS semslam::low)',
    'src/mid/mid.cc': '#include "semslam/low/low.h"\n',
    'include/semslam/mid/mid.h': '#include "semslam/low/low.h"\n',
    'src/high/CMakeLists.txt': 'semslam_add_module(high SOURCES a.cc PRIVATE_DEPENDS semslam::mid)',
    'src/high/a.cc': '#include "semslam/mid/mid.h"\n#include "semslam/low/low.h"\n',
}
VIOLATIONS = {
    'upward edge': ('src/low/CMakeLists.txt', 'semslam_add_module(low DEPENDS semslam::mid)',
                    'must not depend on mid'),
    'unlisted module': ('src/new/CMakeLists.txt', 'semslam_add_module(new SOURCES a.cc)',
                        'new is not in SEMSLAM_MODULES'),
    'include without an edge': ('src/mid/other.cc', '#include "semslam/high/high.h"\n',
                                'src/mid/other.cc:1: module mid does not depend on high'),
    'private edge in a header': ('include/semslam/high/a.h', '\n#include "semslam/mid/mid.h"\n',
                                 'include/semslam/high/a.h:2: module high does not depend on mid'),
    'heavy public header': ('include/semslam/low/b.h', '#include <pcl/point_types.h>\n',
                            'in .cc files only'),
    'heavy private header': ('src/mid/b.h', '#include  <ceres/ceres.h>\n', 'in .cc files only'),
    'private header of another': ('src/mid/c.cc', '#include "low/detail.h"\n',
                                  'low/detail.h is private to module low'),
    'private header in a public one': ('include/semslam/low/c.h', '#include "low/detail.h"\n',
                                       'a public header includes the private'),
    'relative path': ('src/mid/d.cc', '#include "../low/detail.h"\n', 'no relative paths'),
    'file outside any module': ('src/lost/a.cc', '', 'no src/lost/CMakeLists.txt'),
}


def check_fixture(files):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding='utf-8')
        return check(root)


def self_test():
    problems = [f'sound tree: {line}' for line in check_fixture(SOUND)]
    for name, (path, text, expected) in VIOLATIONS.items():
        found = check_fixture({**SOUND, path: text})
        if not any(expected in line for line in found):
            problems.append(f'{name}: expected "{expected}", found {found}')
    return problems


def main(arguments):
    if arguments == ['--self-test']:
        problems = self_test()
    elif len(arguments) <= 1 and not any(a.startswith('-') for a in arguments):
        default = pathlib.Path(__file__).resolve().parent.parent
        problems = check(pathlib.Path(arguments[0]) if arguments else default)
    else:
        print(__doc__)
        return 0 if arguments in (['--help'], ['-h']) else 2
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
