#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""The work of tidy.sh: runs clang-tidy on each own source of the compile database once."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / 'build' / 'release'
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


def own_sources():
    database = json.loads((BUILD / 'compile_commands.json').read_text(encoding='utf-8'))
    files = {pathlib.Path(entry['file']) for entry in database}
    return sorted(f for f in files if f.is_relative_to(ROOT / 'src')
                  or f.is_relative_to(ROOT / 'Examples'))


def git(*arguments):
    result = subprocess.run(['git', '-C', str(ROOT), *arguments], capture_output=True, text=True)
    return result.stdout.splitlines() if result.returncode == 0 else []


def changed_files():
    base = (git('merge-base', 'HEAD', 'main') or ['HEAD'])[0]
    names = git('diff', '--name-only', base) + git('ls-files', '--others', '--exclude-standard')
    return {ROOT / name for name in names}


def resolve(name, file):
    for folder in (ROOT / 'include', ROOT / 'src', ROOT / 'Examples', file.parent):
        if (folder / name).is_file():
            return (folder / name).resolve()
    return None


def touches(file, changed, known):
    """Whether `file` or an own header that it includes, at any depth, is among `changed`."""
    if file not in known:
        known[file] = file in changed
        text = file.read_text(encoding='utf-8')
        headers = [resolve(name, file) for name in INCLUDE.findall(text)]
        if any(h and touches(h, changed, known) for h in headers):
            known[file] = True
    return known[file]


def check(file, deadline):
    """None if the time was over before it started, else the output of a failure ('' if clean)."""
    if deadline and time.monotonic() > deadline:
        return None
    command = ['clang-tidy-14', '--quiet', '-p', str(BUILD),
               '--extra-arg=-Wno-unknown-warning-option', str(file)]
    result = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    return '' if result.returncode == 0 else result.stdout + result.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--budget', type=float, default=0)
    parser.add_argument('--changed', action='store_true')
    parser.add_argument('files', nargs='*', type=pathlib.Path)
    arguments = parser.parse_args()

    files = own_sources()
    if arguments.files:
        unknown = set(arguments.files) - set(files)
        if unknown:
            sys.exit(f'not compiled by build/release: {", ".join(map(str, sorted(unknown)))}')
        files = arguments.files
    if arguments.changed:
        changed, known = changed_files(), {}
        files = [f for f in files if touches(f, changed, known)]
    if arguments.budget:  # What changed last is likeliest to be wrong.
        order = {name: i for i, name in enumerate(dict.fromkeys(
            n for n in git('log', '--name-only', '--format=', '-n', '300') if n))}
        files.sort(key=lambda f: order.get(f.relative_to(ROOT).as_posix(), len(order)))

    start = time.monotonic()
    deadline = start + arguments.budget if arguments.budget else None
    failed, skipped = [], []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, output in zip(files, pool.map(lambda f: check(f, deadline), files)):
            name = file.relative_to(ROOT).as_posix()
            if output is None:
                skipped.append(name)
            elif output:
                failed.append(name)
                print(output, flush=True)
    if skipped:
        print(f'tidy: time over, {len(skipped)} files not checked: {" ".join(skipped)}')
    print(f'tidy: {len(files) - len(failed) - len(skipped)} files clean, {len(failed)} with '
          f'findings, {time.monotonic() - start:.0f} s')
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
