"""Arrays from NumPy files: what is written comes back, what lies takes no memory, nothing is unpickled."""

import io
import pickle
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from grafu.asset.scan_files import array_from


def stored(array: np.ndarray, version: tuple[int, int] | None = None) -> bytes:
    stream = io.BytesIO()
    np.lib.format.write_array(stream, array, version=version)
    return stream.getvalue()


@given(
    arrays(st.sampled_from(["<f8", "<u2", "|b1", "<i8", "|u1"]), array_shapes(min_dims=0, min_side=0)), st.booleans()
)
def test_arrays_come_back(array, fortran):
    array = np.asfortranarray(array) if fortran else array
    for version in ((1, 0), (2, 0)):
        found = array_from(stored(array, version))
        assert found.dtype == array.dtype
        np.testing.assert_array_equal(found, array)


def lying(shape: str, descr: str = "<f8", rest: int = 64) -> bytes:
    head = f"{{'descr': {descr!r}, 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + bytes(rest)


@pytest.mark.parametrize(
    "shape", ["(9999999999,)", "(2**62, 8)", "(1000000, 1000000)", "(-8,)", "(-2, -4)", "(7,)", "(9,)"]
)
def test_a_header_that_says_another_size_is_refused(shape):
    with pytest.raises(ValueError, match=r"."):
        array_from(lying(shape))


@pytest.mark.parametrize(
    "data", [b"", b"\x93NUMPY", b"\x93NUMPY\x03\x00", stored(np.zeros(3))[:-1], stored(np.zeros(3)) + b"x"]
)
def test_what_is_cut_short_or_goes_on_is_refused(data):
    with pytest.raises(ValueError, match=r"."):
        array_from(data)


class Bad:
    def __reduce__(self):
        return (pytest.fail, ("it was unpickled",))


def test_nothing_is_unpickled():
    with pytest.raises(ValueError, match="another array"):
        array_from(lying("(1,)", "|O", 0) + pickle.dumps([Bad()]))
