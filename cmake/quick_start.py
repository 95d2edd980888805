#!/usr/bin/env python3
"""A start of the program without look-ups that nothing needs: a folder of libraries that are found before the system's.

usage: quick_start.py LIBRARY FOLDER NEVER_CALLED WITH_MANY_LOOK_UPS

LIBRARY is libdeal.ii. It loads some 150 libraries, and the loader looks for each of its 190 000 symbols in all of them.
- Of its libraries whose names match the regular expression NEVER_CALLED, FOLDER gets stand-ins: the same name, no libraries of
  their own, and those symbols that libdeal.ii must find when it is loaded. Functions of a stand-in stop the program, objects
  are zeros.
- Of LIBRARY, and of those that match WITH_MANY_LOOK_UPS, FOLDER gets copies whose references to their own functions, vtables
  and type information are relative, as -Bsymbolic would have made them. Data objects keep their look-up, as the program may
  hold the copy that counts.
- FOLDER/build_ids tells what these were. Where they are that still, nothing is done.

Prints the names of all in FOLDER but LIBRARY. Fails on other machines than x86-64, where the program starts as it always did.
"""

import pathlib
import re
import shutil
import struct
import subprocess
import sys

# kinds of relocations of x86-64 (System V ABI)
R_64, R_GLOB_DAT, R_RELATIVE = 1, 6, 8
EAGER = re.compile(r"\S+\s+\S+\s+R_X86_64_(?:64|GLOB_DAT|COPY|TPOFF64|DTPMOD64)\s+\S+\s+(\S+)")
# kinds and bindings of symbols (gABI)
STT_FUNC, STT_TLS, STT_GNU_IFUNC, STB_GNU_UNIQUE, UNDEFINED = 2, 6, 10, 10, 0
# names of vtables, type information, type names, tables of tables, vtables under construction: nobody copies them
OF_TYPES = (b"_ZTV", b"_ZTI", b"_ZTS", b"_ZTT", b"_ZTC")


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def build_id(library):
    """The number that the linker gave the library: other bytes, other number."""
    return re.search(r"Build ID: (\w+)", output_of("readelf", "-n", library))[1]


def symbols_of(library):
    """The symbols that a library defines, with their kinds, and the set of those that it lacks."""
    defined, lacking = {}, set()
    for line in output_of("readelf", "--dyn-syms", "-W", library).splitlines():
        part = line.split()
        if len(part) > 7 and part[6] == "UND":
            lacking.add(part[7].split("@")[0])
        elif len(part) > 7 and (part[6].isdigit() or part[6] == "ABS"):
            defined[part[7].split("@")[0]] = part[3]
    return defined, lacking


def assembly_of(symbols):
    """Assembly text of a stand-in that has these symbols, given with their kinds."""
    lines = []
    for symbol, what in symbols.items():
        if what == "FUNC":
            section, kind, content = ".text", "@function", "ud2"
        elif what == "TLS":
            section, kind, content = '.section .tbss,"awT",@nobits', "@object", ".zero 16"
        else:
            section, kind, content = ".data\n.balign 16", "@object", ".zero 256"
        lines.append(f'{section}\n.weak "{symbol}"\n.type "{symbol}",{kind}\n"{symbol}": {content}')
    return "\n".join(lines + ['.section .note.GNU-stack,"",@progbits', ""])


def make_stand_ins(library, libraries, names, folder):
    """Stand-ins in the folder for those libraries, given with their paths, that are named."""
    eager = {match[1].split("@")[0] for match in map(EAGER.match, output_of("readelf", "-rW", library).splitlines()) if match}
    wanted = eager & symbols_of(library)[1]
    # what other libraries have as well, as functions of the standard library that many were compiled with, is theirs
    for name, path in libraries.items():
        if name not in names:
            wanted -= symbols_of(path)[0].keys()
    for name in names:
        own = {symbol: what for symbol, what in symbols_of(libraries[name])[0].items() if symbol in wanted}
        subprocess.run(["cc", "-shared", "-nostdlib", "-x", "assembler", "-", "-o", folder / name, f"-Wl,-soname,{name}"],
                       input=assembly_of(own), text=True, check=True)


def relative(data):
    """Changes the bytes of a library in place; returns how many references became relative."""
    if data[:5] != b"\x7fELF\x02" or struct.unpack_from("<H", data, 0x12)[0] != 62:
        raise ValueError("not a library of x86-64")
    (headers,) = struct.unpack_from("<Q", data, 0x28)
    size, number, names_at = struct.unpack_from("<HHH", data, 0x3A)
    sections = [struct.unpack_from("<IIQQQQIIQQ", data, headers + i * size) for i in range(number)]

    def text(at):
        return data[at:data.index(b"\0", at)].decode()

    by_name = {text(sections[names_at][4] + section[0]): section for section in sections}
    symbols, strings, table = by_name[".dynsym"][4], by_name[".dynstr"][4], by_name[".rela.dyn"]
    changed = 0
    for at in range(table[4], table[4] + table[5], 24):
        place, info, addend = struct.unpack_from("<QQq", data, at)
        kind, symbol = info & 0xFFFFFFFF, info >> 32
        if kind not in (R_64, R_GLOB_DAT):
            continue
        name, bits, _, section, value, _ = struct.unpack_from("<IBBHQQ", data, symbols + 24 * symbol)
        binding, what = bits >> 4, bits & 15
        if section == UNDEFINED or binding == STB_GNU_UNIQUE or what in (STT_TLS, STT_GNU_IFUNC):
            continue
        if what != STT_FUNC and bytes(data[strings + name:strings + name + 4]) not in OF_TYPES:
            continue
        # *place = value + addend, to which the loader adds where it puts the library
        struct.pack_into("<QQq", data, at, place, R_RELATIVE, value + (addend if kind == R_64 else 0))
        changed += 1
    return changed


def main(library, folder, never_called, with_many_look_ups):
    library, folder = pathlib.Path(library).resolve(), pathlib.Path(folder)
    libraries = dict(re.findall(r"(\S+) => (/\S+)", output_of("ldd", library)))
    stand_ins = [name for name in libraries if re.match(never_called, name)]
    copies = {library.name: library, **{name: path for name, path in libraries.items() if re.match(with_many_look_ups, name)}}
    stamp = folder / "build_ids"
    said = "".join(f"{name} {build_id(path)}\n" for name, path in copies.items()) + "\n".join(stand_ins)
    if not stamp.exists() or stamp.read_text() != said:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, path in copies.items():
            data = bytearray(pathlib.Path(path).read_bytes())
            relative(data)
            (folder / name).write_bytes(data)
        make_stand_ins(library, libraries, stand_ins, folder)
        (folder / "stand_ins").write_text("\n".join(stand_ins))
        stamp.write_text(said)
    print(";".join(stand_ins + [name for name in copies if name != library.name]))


if __name__ == "__main__":
    main(*sys.argv[1:])
