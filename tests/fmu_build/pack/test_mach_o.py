"""Fat libraries, read back by the rules of the format."""

import struct

import pytest

from fmu_build.pack.mach_o import fat_library

X86_64, ARM64 = 0x01000007, 0x0100000C


def thin(processor, size):
    return struct.pack("<III", 0xFEEDFACF, processor, 3) + bytes([processor & 0xFF]) * size


def test_each_library_lies_on_a_page_and_comes_back():
    libraries = [thin(X86_64, 20_000), thin(ARM64, 5)]
    fat = fat_library(libraries)
    magic, count = struct.unpack_from(">II", fat)
    assert (magic, count) == (0xCAFEBABE, 2)
    for k, (library, processor) in enumerate(zip(libraries, (X86_64, ARM64), strict=True)):
        found, variant, offset, size, align = struct.unpack_from(">IIIII", fat, 8 + 20 * k)
        assert (found, variant, align) == (processor, 3, 14)
        assert offset % (1 << align) == 0
        assert fat[offset : offset + size] == library
    assert len(fat) == offset + size


def test_a_single_library_stays_as_it_is():
    assert fat_library([b"anything"]) == b"anything"


def test_other_files_are_refused():
    with pytest.raises(ValueError, match="0x464c457f"):
        fat_library([thin(X86_64, 1), b"\x7fELF" + bytes(20)])
