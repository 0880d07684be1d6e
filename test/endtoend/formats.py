# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Readers of the files that rgbd_tum writes, and a PNG writer, on the standard library alone.

They share no code with the library, so that a fault in its writers shows. Every reader raises
ValueError for a file that is cut short or contradicts its own header.
"""
import array
import math
import struct
import sys
import zlib

PCD_TYPES = {("F", 4): "f", ("F", 8): "d", ("U", 4): "I", ("U", 1): "B", ("I", 4): "i"}
PLY_TYPES = {"float": "f", "double": "d", "uchar": "B", "uint": "I", "int": "i", "ushort": "H"}


def require(holds, what):
    if not holds:
        raise ValueError(what)


def decompress_lzf(data, size):
    out = bytearray()
    i = 0
    while i < len(data):
        control = data[i]
        i += 1
        if control < 32:
            out += data[i:i + control + 1]
            i += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += data[i]
            i += 1
        start = len(out) - ((control & 31) << 8) - data[i] - 1
        i += 1
        length += 2
        require(start >= 0, "LZF: reference before the start")
        if start + length <= len(out):
            out += out[start:start + length]
        else:
            pattern = bytes(out[start:])
            out += (pattern * (length // len(pattern) + 1))[:length]
    require(len(out) == size, f"LZF: expected {size} bytes, found {len(out)}")
    return bytes(out)


def column(code, data):
    values = array.array(code)
    require(sys.byteorder == "little", "readers are for little-endian machines")
    values.frombytes(data)
    return values


def read_pcd(path):
    """Columns by field name, of a binary_compressed PCD file."""
    data = path.read_bytes()
    end = data.index(b"DATA ")
    end = data.index(b"\n", end) + 1
    header = {}
    for line in data[:end].decode("ascii").splitlines():
        if not line.startswith("#"):
            key, *values = line.split()
            header[key] = values
    require(header["VERSION"] in (["0.7"], [".7"]), f"{path}: version {header['VERSION']}")
    require(header["DATA"] == ["binary_compressed"], f"{path}: DATA {header['DATA']}")
    num_points = int(header["POINTS"][0])
    require(num_points == int(header["WIDTH"][0]) * int(header["HEIGHT"][0]), f"{path}: POINTS")
    sizes = [int(size) for size in header["SIZE"]]
    packed, unpacked = struct.unpack_from("<II", data, end)
    require(unpacked == num_points * sum(sizes), f"{path}: {unpacked} bytes unpacked")
    require(len(data) == end + 8 + packed, f"{path}: {len(data)} bytes")
    body = decompress_lzf(data[end + 8:], unpacked)
    columns = {}
    begin = 0
    for name, size, kind in zip(header["FIELDS"], sizes, header["TYPE"], strict=True):
        columns[name] = column(PCD_TYPES[kind, size], body[begin:begin + size * num_points])
        begin += size * num_points
    return columns


def read_ply(path):
    """Columns by property name, of a binary little-endian PLY file with vertices only."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode("ascii").splitlines()
    require(lines[0] == "ply" and "format binary_little_endian 1.0" in lines, f"{path}: format")
    num_points = None
    properties = []
    for line in lines:
        words = line.split()
        if words[0] == "element":
            require(words[1] == "vertex", f"{path}: {line}")
            num_points = int(words[2])
        if words[0] == "property":
            properties.append((words[2], PLY_TYPES[words[1]]))
    row = struct.Struct("<" + "".join(code for _, code in properties))
    require(len(data) - end == row.size * num_points, f"{path}: {len(data) - end} bytes")
    rows = list(row.iter_unpack(data[end:]))
    values = list(zip(*rows)) if rows else [()] * len(properties)
    return {name: values[i] for i, (name, _) in enumerate(properties)}


def read_trajectory(path):
    """Rows of t, x, y, z, qx, qy, qz, qw; times increase, quaternions have length 1."""
    text = path.read_text()
    require(not text or text.endswith("\n"), f"{path}: cut short")
    rows = []
    for line in text.splitlines():
        if line.startswith("#"):
            continue
        row = tuple(float(word) for word in line.split())
        require(len(row) == 8 and all(map(math.isfinite, row)), f"{path}: {line}")
        require(abs(math.hypot(*row[4:]) - 1) < 1e-6, f"{path}: no unit quaternion: {line}")
        require(not rows or row[0] > rows[-1][0], f"{path}: times do not increase: {line}")
        rows.append(row)
    return rows


def read_png_size(path):
    """Width and height of a PNG file, all of whose chunks are whole."""
    data = path.read_bytes()
    require(data[:8] == b"\x89PNG\r\n\x1a\n", f"{path}: no PNG")
    position = 8
    kind = b""
    while position < len(data):
        length, kind = struct.unpack_from(">I4s", data, position)
        body = data[position + 8:position + 8 + length]
        crc, = struct.unpack_from(">I", data, position + 8 + length)
        require(crc == zlib.crc32(kind + body), f"{path}: wrong check sum")
        position += 12 + length
    require(kind == b"IEND", f"{path}: no end")
    return struct.unpack_from(">II", data, 16)


def write_png(path, width, height, bit_depth=8, num_channels=3, value=0):
    """An image of one value."""
    def chunk(kind, body):
        checksum = struct.pack(">I", zlib.crc32(kind + body))
        return struct.pack(">I", len(body)) + kind + body + checksum

    color_type = {1: 0, 3: 2}[num_channels]
    row = b"\0" + value.to_bytes(bit_depth // 8, "big") * (width * num_channels)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bit_depth, color_type,
                                                0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(row * height)) + chunk(b"IEND", b""))
