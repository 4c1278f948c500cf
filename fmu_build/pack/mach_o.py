"""A macOS library for several processors: thin Mach-O files joined behind a fat header.

Source: the declarations in Apple's <mach-o/fat.h> and <mach-o/loader.h>.
"""

import struct
from collections.abc import Sequence

_FAT_MAGIC = 0xCAFEBABE
_THIN_MAGIC = 0xFEEDFACF  # 64 bit, little-endian on every processor in use
_ALIGN_LOG2 = 14  # pages of ARM Macs: 16 KiB


def fat_library(thin: Sequence[bytes]) -> bytes:
    """One library out of thin ones; a single one stays as it is."""
    if len(thin) == 1:
        return thin[0]
    header = struct.pack(">II", _FAT_MAGIC, len(thin))
    body, position = b"", _aligned(len(header) + 20 * len(thin))
    start = position
    for library in thin:
        magic, processor, variant = struct.unpack_from("<III", library)
        if magic != _THIN_MAGIC:
            raise ValueError(f"not a 64-bit Mach-O file: magic number {magic:#x}")
        body += bytes(position - start - len(body)) + library
        header += struct.pack(">IIIII", processor, variant, position, len(library), _ALIGN_LOG2)
        position = _aligned(position + len(library))
    return header + bytes(start - len(header)) + body


def _aligned(position: int) -> int:
    page = 1 << _ALIGN_LOG2
    return -(-position // page) * page
