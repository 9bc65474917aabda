"""A folder of tables as its manifest describes it, by numpy alone: each reader written from its format's specification."""
import json
import pathlib
import struct
import zlib

import numpy as np


def read_dds(data):
    """DDS with the DX10 header, DXGI_FORMAT_R16G16B16A16_FLOAT (10)."""
    assert data[:4] == b"DDS " and data[84:88] == b"DX10" and struct.unpack_from("<I", data, 128) == (10,)
    height, width = struct.unpack_from("<2I", data, 12)
    return np.frombuffer(data, "<f2", width * height * 4, 148).reshape(height, width, 4)


def read_ktx2(data):
    """KTX 2.0, VK_FORMAT_R16G16B16A16_SFLOAT (97), level 0; its descriptor must say linear data without primaries."""
    assert data[:12] == b"\xabKTX 20\xbb\r\n\x1a\n"
    vk_format, type_size, width, height = struct.unpack_from("<4I", data, 12)
    descriptor, key_values, key_value_bytes = struct.unpack_from("<I4xII", data, 48)
    offset, length, uncompressed = struct.unpack_from("<3Q", data, 80)
    assert (vk_format, type_size, length, offset % 8) == (97, 2, width * height * 8, 0) and uncompressed == length
    model, primaries, transfer, flags = data[descriptor + 12:descriptor + 16]
    assert (model, primaries, transfer, flags) == (1, 0, 1, 0)
    pairs = {}
    while key_value_bytes > 0:
        size, = struct.unpack_from("<I", data, key_values)
        key, value = data[key_values + 4:key_values + 4 + size].split(b"\0", 1)
        pairs[key.decode()] = value.rstrip(b"\0").decode()
        step = 4 + (size + 3) // 4 * 4
        key_values, key_value_bytes = key_values + step, key_value_bytes - step
    assert pairs["KTXorientation"] == "rd" and list(pairs) == sorted(pairs)
    return np.frombuffer(data, "<f2", width * height * 4, offset).reshape(height, width, 4)


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def exr_header(data):
    at, found = 8, {}
    while data[at]:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        size, = struct.unpack_from("<i", data, at)
        found[name], at = data[at + 4:at + 4 + size], at + 4 + size
    return found, at + 1


def exr_channels(raw):
    at, names = 0, []
    while raw[at]:
        name, at = text_at(raw, at)
        assert struct.unpack_from("<i", raw, at) == (1,)  # half
        names.append(name)
        at += 16
    return names


def exr_block(raw, size):
    """ZIP: deflate, then differences of bytes, then the two halves of the bytes interleaved."""
    if len(raw) == size:
        return raw
    bytes_ = np.frombuffer(zlib.decompress(raw), np.uint8).astype(np.int64)
    bytes_[1:] -= 128
    bytes_ = np.cumsum(bytes_) % 256
    half = (len(bytes_) + 1) // 2
    result = np.empty(len(bytes_), np.uint8)
    result[0::2], result[1::2] = bytes_[:half], bytes_[half:]
    return result.tobytes()


def read_exr(data):
    """OpenEXR, scan lines, ZIP, half."""
    header, at = exr_header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    names, width, height = exr_channels(header["channels"]), x1 - x0 + 1, y1 - y0 + 1
    assert header["compression"] == b"\3"
    image = np.zeros((height, width, len(names)))
    for offset in struct.unpack_from(f"<{(height + 15) // 16}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        rows = min(16, height - (y - y0))
        block = exr_block(data[offset + 8:offset + 8 + size], rows * width * len(names) * 2)
        values = np.frombuffer(block, "<f2").reshape(rows, len(names), width)
        image[y - y0:y - y0 + rows] = values.transpose(0, 2, 1)
    return image[:, :, [names.index(name) for name in "RGBA" if name in names]]


def png_row(filter_, row, above, bpp):
    """One line after its filter is undone (PNG specification, section 9)."""
    out = bytearray(row)
    for i in range(len(out)):
        left, up, corner = (out[i - bpp], above[i], above[i - bpp]) if i >= bpp else (0, above[i], 0)
        p = left + up - corner
        paeth = min((left, up, corner), key=lambda v: abs(p - v))
        out[i] = (out[i] + (0, left, up, (left + up) // 2, paeth)[filter_]) & 255
    return out


def read_png(data):
    """PNG, 8 or 16 bits, rgb or rgba, not interlaced; nothing may claim a transfer curve."""
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        assert kind not in (b"sRGB", b"iCCP")
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += size + 12
    channels = {0: 1, 2: 3, 6: 4}[color]
    bpp, raw = channels * bits // 8, zlib.decompress(packed)
    rows, above = [], bytearray(width * bpp)
    for y in range(height):
        start = y * (width * bpp + 1)
        above = png_row(raw[start], raw[start + 1:start + 1 + width * bpp], above, bpp)
        rows.append(bytes(above))
    values = np.frombuffer(b"".join(rows), ">u2" if bits == 16 else "u1").reshape(height, width, channels)
    return values / (2 ** bits - 1)


READERS = {"exr": read_exr, "png8": read_png, "png16": read_png, "dds": read_dds, "ktx2": read_ktx2}


class Tables:
    """The values of a folder (stored times scale), by table name."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.manifest = json.loads((self.folder / "manifest.json").read_text())
        self.tables = {table["name"]: table for table in self.manifest["tables"]}
        self.values = {name: self.decoded(table) for name, table in self.tables.items()}

    def decoded(self, table):
        stored = READERS[self.manifest["format"]]((self.folder / table["file"]).read_bytes()).astype(float)
        scales = [channel["scale"] for channel in table["channels"]]
        return stored[:, :, :len(scales)] * scales

    def at(self, name, u, v):
        """Bilinear and clamped, at texture coordinates: an array of points by channels."""
        values = self.values[name]
        height, width, _ = values.shape
        x, y = np.clip(np.asarray(u) * width - 0.5, 0, width - 1), np.clip(np.asarray(v) * height - 0.5, 0, height - 1)
        x0, y0 = x.astype(int), y.astype(int)
        x1, y1 = np.minimum(x0 + 1, width - 1), np.minimum(y0 + 1, height - 1)
        fx, fy = (x - x0)[:, None], (y - y0)[:, None]
        top, bottom = values[y0, x0] * (1 - fx) + values[y0, x1] * fx, values[y1, x0] * (1 - fx) + values[y1, x1] * fx
        return top * (1 - fy) + bottom * fy

    def read(self, name, u_value, v_value):
        """The same at values of the two axes."""
        u, v = self.tables[name]["u"], self.tables[name]["v"]
        return self.at(name, u_value * u["scale"] + u["bias"], v_value * v["scale"] + v["bias"])

    def scattering(self, light, eye, tangent):
        """S of the layouts nalu, nalu_caustic, karis and half_vector from unit vectors, one a row."""
        sine_i, sine_o = (light * tangent).sum(1), (eye * tangent).sum(1)
        cosines = np.sqrt((1 - sine_i ** 2) * (1 - sine_o ** 2))
        cos_phi = np.clip(((light * eye).sum(1) - sine_i * sine_o) / cosines, -1, 1)
        if self.manifest["layout"] == "nalu_caustic":
            return self.caustic_scattering(np.arcsin(sine_i), np.arcsin(sine_o), np.arccos(cos_phi))
        if self.manifest["layout"] == "karis":
            return self.karis_scattering(np.arcsin(sine_i), np.arcsin(sine_o), np.arccos(cos_phi), (light * eye).sum(1))
        if self.manifest["layout"] == "half_vector":
            return self.half_vector_scattering(light, eye, tangent, np.sqrt(1 - sine_i ** 2) * cos_phi)
        m = self.read("M", sine_i, sine_o)
        tt_r, trt = self.read("N_TT_R", cos_phi, m[:, 3]), self.read("N_TRT", cos_phi, m[:, 3])
        return m[:, :1] * tt_r[:, 3:] + m[:, 1:2] * tt_r[:, :3] + m[:, 2:3] * trt

    def caustic_scattering(self, theta_i, theta_o, phi):
        """N_TRT as its axis' formula in the manifest says."""
        theta_d, axis = abs(theta_o - theta_i) / 2, self.tables["N_TRT"]["u"]
        glass, squared = axis["eta"] ** 2 - 1, np.cos(theta_d) ** 2
        q = 3 * squared - glass
        place = 2 * np.arctan(np.maximum(q, 0) ** 1.5 / (np.sqrt(glass) * (glass + 9 * squared)))
        inside = phi < place
        root = np.sqrt(abs(phi - place) / np.where(inside, place, np.pi - place))
        held = np.maximum(np.where(inside, q * root, abs(q) + 4 * (phi - place)), 1e-5)
        value = np.where(inside, -1, 1) * (axis["gap"] + (1 - axis["gap"]) * root)
        m, tt_r = self.read("M", theta_i, theta_o), self.read("N_TT_R", phi, theta_d)
        trt = self.read("N_TRT", value, theta_d) / held[:, None]
        return m[:, :1] * tt_r[:, 3:] + m[:, 1:2] * tt_r[:, :3] + m[:, 2:3] * trt

    def karis_scattering(self, theta_i, theta_o, phi, cosine):
        """N_R by half the angle between light and eye."""
        m, tt = self.read("M", theta_i, theta_o), self.read("N_TT", phi, abs(theta_o - theta_i) / 2)
        trt, r = self.read("N_TRT", phi, abs(theta_o - theta_i) / 2), self.read("N_R", phi, np.arccos(cosine) / 2)
        return m[:, :1] * r + m[:, 1:2] * tt + m[:, 2:3] * trt

    def half_vector_scattering(self, light, eye, tangent, cos_normal):
        """Highlights by the half vector's angles."""
        half = light + eye
        half /= np.linalg.norm(half, axis=1, keepdims=True)
        sine = (half * tangent).sum(1)
        across, seen = half - sine[:, None] * tangent, eye - (eye * tangent).sum(1)[:, None] * tangent
        cosine = (across * seen).sum(1) / (np.linalg.norm(across, axis=1) * np.linalg.norm(seen, axis=1))
        return self.read("diffuse", cos_normal, 0 * cos_normal) + self.read("highlights", np.arccos(np.clip(cosine, -1, 1)), np.arcsin(sine))
