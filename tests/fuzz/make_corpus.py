#!/usr/bin/env python3
"""Writes the small files that the fuzz targets begin with, and the files beside them, to tests/fuzz/corpus.

Entries that a search has found are kept beside these and not touched. Run it again after changing it: the same files
come out everywhere.
"""
import base64
import gzip
import itertools
import json
import pathlib
import shutil
import struct
import zlib

root = pathlib.Path(__file__).parent / "corpus"
examples = pathlib.Path(__file__).parents[2] / "examples"


def write(name, content):
    path = root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def zipped(data):
    return gzip.compress(data, mtime=0)


# --- a cube of six tetrahedra, and one more on top of it -----------------------------------------------------------

def cube(base):
    """Kuhn's split; corners by their bits x, y, z. Neighbours along z conform."""
    result = []
    for axes in itertools.permutations(range(3)):
        corners, at = [0], 0
        for a in axes:
            at |= 1 << a
            corners.append(at)
        if sum(axes[i] > axes[j] for i in range(3) for j in range(i + 1, 3)) % 2:
            corners[1], corners[2] = corners[2], corners[1]
        result.append([base + c for c in corners])
    return result


points = [(x, y, z) for z in range(3) for y in range(2) for x in range(2)]
lower, upper = cube(0), cube(4)


def boundary(tetrahedra):
    faces = {}
    for t in tetrahedra:
        for f in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)):
            triangle = tuple(t[i] for i in f)
            faces.setdefault(tuple(sorted(triangle)), []).append(triangle)
    return [f[0] for f in faces.values() if len(f) == 1]


def at_height(triangles, z):
    return [t for t in triangles if all(points[n][2] == z for n in t)]


outside = boundary(lower)
inlet, outlet = at_height(outside, 0), at_height(outside, 1)
side = [t for t in outside if t not in inlet + outlet]


# --- Gmsh ---------------------------------------------------------------------------------------------------------

def gmsh(binary, fields):
    both = boundary(upper)
    ends = [t for t in both if t not in at_height(both, 1)]
    blocks = [(2, 1, 2, inlet), (2, 2, 2, side), (2, 3, 2, outlet), (2, 4, 2, ends), (3, 1, 4, lower), (3, 2, 4, upper)]
    names = [(2, 1, "inlet"), (2, 2, "side"), (2, 3, "interface"), (2, 4, "outside"), (3, 1, "lumen"), (3, 2, "wall")]
    i = (lambda *v: struct.pack("<%di" % len(v), *v)) if binary else (lambda *v: (" ".join(map(str, v)) + " ").encode())
    n = (lambda *v: struct.pack("<%dQ" % len(v), *v)) if binary else (lambda *v: (" ".join(map(str, v)) + " ").encode())
    d = (lambda *v: struct.pack("<%dd" % len(v), *v)) if binary else (lambda *v: (" ".join(map(str, v)) + " ").encode())
    line = b"" if binary else b"\n"
    out = b"$MeshFormat\n4.1 %d 8\n" % binary + (struct.pack("<i", 1) + b"\n" if binary else b"") + b"$EndMeshFormat\n"
    out += b"$PhysicalNames\n%d\n" % len(names)
    out += b"".join(b'%d %d "%s"\n' % (a, b, c.encode()) for a, b, c in names) + b"$EndPhysicalNames\n"
    out += b"$Entities\n" + n(0, 0, 4, 2) + line
    for tag in range(1, 5):
        out += i(tag) + d(0, 0, 0, 1, 1, 2) + n(1) + i(tag) + n(0) + line
    for tag in range(1, 3):
        out += i(tag) + d(0, 0, 0, 1, 1, 2) + n(1) + i(tag) + n(0) + line
    out += b"\n$EndEntities\n$Nodes\n" + n(1, len(points), 1, len(points)) + line + i(3, 1, 0) + n(len(points)) + line
    out += line.join(n(k + 1) for k in range(len(points))) + line
    out += line.join(d(*p) for p in points) + b"\n$EndNodes\n$Elements\n"
    count = sum(len(b[3]) for b in blocks)
    out += n(len(blocks), count, 1, count) + line
    tag = 0
    for dimension, entity, kind, elements in blocks:
        out += i(dimension, entity, kind) + n(len(elements)) + line
        for element in elements:
            tag += 1
            out += n(tag, *(v + 1 for v in element)) + line
    out += b"\n$EndElements\n"
    if fields:
        first = count - 11
        out += b'$ElementData\n1\n"e1"\n1\n0.0\n3\n0\n3\n12\n'
        for k in range(12):
            out += i(first + k) + d(1, 0, 0.5) + line
        out += b"\n$EndElementData\n"
    return out


# --- VTK XML ------------------------------------------------------------------------------------------------------

def vtk(kind, nodes, cells, how, cell_arrays, point_arrays=()):
    """how: ascii, base64, zlib or raw."""
    appended = b""

    def array(name, values, type_name, code, components=1):
        nonlocal appended
        head = '<DataArray type="%s" Name="%s" NumberOfComponents="%d"' % (type_name, name, components)
        data = struct.pack("<%d%s" % (len(values), code), *values)
        if how == "ascii":
            return head + ' format="ascii">' + " ".join(map(str, values)) + "</DataArray>\n"
        if how == "base64":
            return head + ' format="binary">' + base64.b64encode(struct.pack("<I", len(data)) + data).decode() + \
                "</DataArray>\n"
        if how == "zlib":
            packed = zlib.compress(data)
            lengths = struct.pack("<4I", 1, 32768, len(data), len(packed))
            return head + ' format="binary">' + (base64.b64encode(lengths) + base64.b64encode(packed)).decode() + \
                "</DataArray>\n"
        offset = len(appended)
        appended += struct.pack("<I", len(data)) + data
        return head + ' format="appended" offset="%d"/>\n' % offset

    volume = kind == "UnstructuredGrid"
    flat = [n for c in cells for n in c]
    size = len(cells[0])
    text = '<?xml version="1.0"?>\n<VTKFile type="%s" version="0.1" byte_order="LittleEndian"%s>\n<%s>\n' % (
        kind, ' compressor="vtkZLibDataCompressor"' if how == "zlib" else "", kind)
    counts = 'NumberOfCells="%d"' % len(cells) if volume else \
        'NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="%d"' % len(cells)
    text += '<Piece NumberOfPoints="%d" %s>\n<PointData>\n' % (len(nodes), counts)
    text += "".join(array(*a) for a in point_arrays) + "</PointData>\n<CellData>\n"
    text += "".join(array(*a) for a in cell_arrays) + "</CellData>\n<Points>\n"
    text += array("Points", [x for p in nodes for x in p], "Float64", "d", 3) + "</Points>\n"
    text += "<Cells>\n" if volume else "<Polys>\n"
    text += array("connectivity", flat, "Int64", "q")
    text += array("offsets", [size * (k + 1) for k in range(len(cells))], "Int64", "q")
    if volume:
        text += array("types", [24 if size == 10 else 10] * len(cells), "UInt8", "B")
    text += ("</Cells>\n" if volume else "</Polys>\n") + "</Piece>\n</%s>\n" % kind
    out = text.encode()
    if appended:
        out += b'<AppendedData encoding="raw">\n_' + appended + b"\n</AppendedData>\n"
    return out + b"</VTKFile>\n"


def volume(how, extra=()):
    ids = ("GlobalElementID", range(1, 7), "Int32", "i")
    region = ("region", [1, 1, 1, 2, 2, 2], "Int32", "i")
    return vtk("UnstructuredGrid", points[:8], lower, how, [ids, region, *extra],
               [("GlobalNodeID", range(1, 9), "Int32", "i")])


def quadratic_volume(how, extra):
    nodes, middle, cells = list(points[:8]), {}, []
    for t in lower:
        cell = list(t)
        for a, b in ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)):
            ends = tuple(sorted((t[a], t[b])))
            if ends not in middle:
                middle[ends] = len(nodes)
                nodes.append(tuple((points[ends[0]][i] + points[ends[1]][i]) / 2 for i in range(3)))
            cell.append(middle[ends])
        cells.append(cell)
    return vtk("UnstructuredGrid", nodes, cells, how, [("GlobalElementID", range(1, 7), "Int32", "i"), *extra])


def face(triangles, how):
    used = sorted({n for t in triangles for n in t})
    element = {t: 1 + next(k for k, e in enumerate(lower) if set(t) <= set(e)) for t in triangles}
    return vtk("PolyData", [points[n] for n in used], [[used.index(n) for n in t] for t in triangles], how,
               [("GlobalElementID", [element[t] for t in triangles], "Int32", "i")],
               [("GlobalNodeID", [n + 1 for n in used], "Int32", "i"), ("thickness", [0.1] * len(used), "Float64", "d")])


def results(how):
    return vtk("UnstructuredGrid", points[:8], lower, how,
               [("von Mises stress [kPa]", [0.5 * k for k in range(6)], "Float32", "f")],
               [("displacement [mm]", [0.25 * k for k in range(24)], "Float32", "f", 3)])


def mesh_corpus():
    write("mesh/gmsh/cubes.msh", gmsh(0, False))
    write("mesh/gmsh/cubes_binary.msh", gmsh(1, False))
    write("mesh/gmsh_fields/cubes.msh", gmsh(0, True))
    write("mesh/gmsh_fields/cubes_binary.msh", gmsh(1, True))
    for how in ("ascii", "base64", "zlib", "raw"):
        write("mesh/volume/cube_%s.vtu" % how, volume(how))
        write("mesh/face/inlet_%s.vtp" % how, face(inlet, how))
    for how in ("zlib", "raw"):
        write("mesh/results/wall_%s.vtu" % how, results(how))
    write("mesh/pieces/wall.pvtu",
          '<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid" version="0.1" byte_order="LittleEndian">\n'
          '  <PUnstructuredGrid GhostLevel="0">\n    <PPointData>\n'
          '      <PDataArray type="Float32" Name="displacement [mm]" NumberOfComponents="3"/>\n    </PPointData>\n'
          '    <PCellData>\n      <PDataArray type="Float32" Name="von Mises stress [kPa]" NumberOfComponents="1"/>\n'
          '    </PCellData>\n    <PPoints>\n'
          '      <PDataArray type="Float32" Name="Points" NumberOfComponents="3"/>\n    </PPoints>\n'
          '    <Piece Source="wall_0.vtu"/>\n    <Piece Source="wall_1.vtu"/>\n  </PUnstructuredGrid>\n</VTKFile>\n')
    for target in ("mesh", "artifacts"):
        write(target + "/beside/sv/mesh-complete.mesh.vtu", volume("ascii"))
        for name, triangles in (("inlet", inlet), ("outlet", outlet), ("side", side)):
            write(target + "/beside/sv/mesh-surfaces/%s.vtp" % name, face(triangles, "ascii"))


# --- surfaces -----------------------------------------------------------------------------------------------------

def stl(triangles):
    text = "solid cube\n"
    for t in triangles:
        text += "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % points[n] for n in t)
        text += "endloop\nendfacet\n"
    return text + "endsolid cube\n"


def stl_binary(triangles):
    out = b"cube".ljust(80) + struct.pack("<I", len(triangles))
    for t in triangles:
        out += struct.pack("<12fH", 0, 0, 0, *(x for n in t for x in points[n]), 0)
    return out


def ply(triangles, how):
    text = "ply\nformat %s 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n" \
        "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (how, len(triangles))
    if how == "ascii":
        text += "".join("%g %g %g\n" % p for p in points[:8])
        return (text + "".join("3 %d %d %d\n" % t for t in triangles)).encode()
    order = "<" if how == "binary_little_endian" else ">"
    out = b"".join(struct.pack(order + "3f", *p) for p in points[:8])
    return text.encode() + out + b"".join(struct.pack(order + "B3i", 3, *t) for t in triangles)


def obj(triangles):
    return "# a cube\n" + "".join("v %g %g %g\n" % p for p in points[:8]) + \
        "".join("f %d %d %d\n" % tuple(n + 1 for n in t) for t in triangles)


def surface_corpus():
    for name, triangles in (("closed", outside), ("open", side)):
        write("surface/surface/%s.stl" % name, stl(triangles))
        write("surface/surface/%s_binary.stl" % name, stl_binary(triangles))
        for how in ("ascii", "binary_little_endian", "binary_big_endian"):
            write("surface/surface/%s_%s.ply" % (name, how), ply(triangles, how))
        write("surface/surface/%s.obj" % name, obj(triangles))
        for how in ("ascii", "base64", "zlib", "raw"):
            write("surface/surface/%s_%s.vtp" % (name, how),
                  vtk("PolyData", points[:8], [list(t) for t in triangles], how, []))


# --- images -------------------------------------------------------------------------------------------------------

labels = [(k * 7) % 3 for k in range(4 * 3 * 2)]
shorts = struct.pack("<24h", *labels)
text_labels = " ".join(map(str, labels)) + "\n"


def nrrd(fields, data=b""):
    return ("NRRD0005\n# labels\ndimension: 3\nsizes: 4 3 2\n" + fields + "\nnote:=made by hand\n\n").encode() + data


def metaimage(fields, data=b"", file="LOCAL", kind="MET_SHORT"):
    return ("ObjectType = Image\nNDims = 3\n" + fields + "\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 1 2 3\n"
            "CenterOfRotation = 0 0 0\nElementSpacing = 0.5 0.6 0.7\nDimSize = 4 3 2\nElementType = " + kind +
            "\nElementDataFile = " + file + "\n").encode() + data


def nifti_1(order, sform):
    h = bytearray(352)
    def put(at, form, *values):
        struct.pack_into(order + form, h, at, *values)
    put(0, "i", 348)
    put(40, "8h", 3, 4, 3, 2, 1, 1, 1, 1)
    put(70, "hh", 4, 16)
    put(76, "8f", 1, 0.5, 0.6, 0.7, 0, 0, 0, 0)
    put(108, "3f", 352, 1, 0)
    h[123] = 2
    put(252, "hh", 0 if sform else 1, 1 if sform else 0)
    put(256, "6f", 0, 0, 0.7071068, 10, 20, 30)
    put(280, "12f", 0.5, 0, 0, 10, 0, 0.6, 0, 20, 0, 0, 0.7, 30)
    h[344:348] = b"n+1\0"
    return bytes(h) + struct.pack(order + "24h", *labels)


def nifti_2():
    h = bytearray(544)
    struct.pack_into("<i8s2h8q", h, 0, 540, b"n+2\0\r\n\x1a\n", 4, 16, 3, 4, 3, 2, 1, 1, 1, 1)
    struct.pack_into("<8d", h, 104, 1, 0.5, 0.6, 0.7, 0, 0, 0, 0)
    struct.pack_into("<q2d", h, 168, 544, 0, 0)
    struct.pack_into("<2i", h, 344, 0, 1)
    struct.pack_into("<12d", h, 400, 0.5, 0, 0, 10, 0, 0.6, 0, 20, 0, 0, 0.7, 30)
    struct.pack_into("<i", h, 500, 2)
    return bytes(h) + shorts


def image_corpus():
    oblique = 'space: left-posterior-superior\nspace directions: (0.5,0,0) (0,0.6,0.1) (0,-0.1,0.7)\n' \
        'space units: "mm" "mm" "mm"\nspace origin: (1,2,3)\nendian: little\ntype: short\n'
    write("image/nrrd/gzip.nrrd", nrrd(oblique + "encoding: gzip", zipped(shorts)))
    write("image/nrrd/members.nrrd", nrrd(oblique + "encoding: gzip", zipped(shorts[:20]) + zipped(shorts[20:])))
    write("image/nrrd/raw.nrrd", nrrd("spacings: 0.5 0.6 0.7\naxis mins: 1 2 3\ncenters: cell cell node\nendian: big\n"
                                      "type: unsigned short\nencoding: raw", struct.pack(">24H", *labels)))
    write("image/nrrd/text.nrrd", nrrd("space: RAS\nspace directions: (0.5,0,0) (0,0.6,0) (0,0,0.7)\ntype: uchar\n"
                                       "encoding: ascii", text_labels.encode()))
    write("image/nrrd/floats.nrrd", nrrd("spacings: 1 1 1\ntype: double\nendian: little\nencoding: raw",
                                         struct.pack("<24d", *labels)))
    write("image/nrrd/detached.nhdr", nrrd(oblique + "encoding: raw\nline skip: 1\nbyte skip: 4\ndata file: headed.raw"))
    write("image/nrrd/at_end.nhdr", nrrd(oblique + "encoding: raw\nbyte skip: -1\ndata file: headed.raw"))
    write("image/beside/headed.raw", b"a line\n1234" + shorts)
    write("image/metaimage/raw.mha", metaimage("BinaryData = True\nBinaryDataByteOrderMSB = False", shorts))
    packed = zlib.compress(shorts)
    write("image/metaimage/zlib.mha",
          metaimage("BinaryData = True\nCompressedData = True\nCompressedDataSize = %d" % len(packed), packed))
    write("image/metaimage/text.mha", metaimage("BinaryData = False", text_labels.encode(), kind="MET_UCHAR"))
    write("image/metaimage/detached.mhd", metaimage("HeaderSize = -1\nComment = labels", file="headed.raw"))
    write("image/nifti/quaternion.nii", nifti_1("<", False))
    write("image/nifti/rows.nii", nifti_1(">", True))
    write("image/nifti/second.nii", nifti_2())
    write("image/nifti/rows.nii.gz", zipped(nifti_1("<", True)))
    whole = nifti_2()
    write("image/nifti/members.nii.gz", zipped(whole[:400]) + zipped(whole[400:]))
    series_corpus()


def series_corpus():
    """Two times of a number, or of a vector, for each of 4 x 3 x 2 voxels."""
    floats = struct.pack("<48f", *(0.1 * (k % 5) for k in range(48)))
    vectors = struct.pack("<72f", *(0.1 * (k % 7) for k in range(72)))
    header = bytearray(nifti_1("<", True)[:352])
    struct.pack_into("<8h", header, 40, 4, 4, 3, 2, 2, 1, 1, 1)
    struct.pack_into("<hh", header, 70, 16, 32)
    struct.pack_into("<8f", header, 76, 1, 0.5, 0.6, 0.7, 0.04, 0, 0, 0)
    header[123] = 2 + 8
    write("image/series/times.nii", bytes(header) + floats)
    write("image/series/times.nii.gz", zipped(bytes(header) + floats))
    struct.pack_into("<8h", header, 40, 5, 4, 3, 2, 1, 3, 1, 1)
    write("image/series/vectors.nii", bytes(header) + vectors)
    shape = "space: left-posterior-superior\nspace origin: (1,2,3)\nendian: little\ntype: float\nencoding: raw\n"
    write("image/series/times.nrrd",
          ("NRRD0005\ndimension: 4\nsizes: 4 3 2 2\nkinds: domain domain domain list\n"
           "space directions: (0.5,0,0) (0,0.6,0.1) (0,-0.1,0.7) none\n" + shape + "\n").encode() + floats)
    write("image/series/vectors.nrrd",
          ("NRRD0005\ndimension: 4\nsizes: 3 4 3 2\nkinds: vector domain domain domain\n"
           "space directions: none (0.5,0,0) (0,0.6,0.1) (0,-0.1,0.7)\n" + shape + "\n").encode() + vectors)
    write("image/series/times.mha",
          ("ObjectType = Image\nNDims = 4\nBinaryData = True\nOffset = 1 2 3 0\nElementSpacing = 0.5 0.6 0.7 0.04\n"
           "DimSize = 4 3 2 2\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n").encode() + floats)
    write("image/series/vectors.mha",
          ("ObjectType = Image\nNDims = 3\nBinaryData = True\nOffset = 1 2 3\nElementSpacing = 0.5 0.6 0.7\n"
           "DimSize = 4 3 2\nElementNumberOfChannels = 3\nElementType = MET_FLOAT\n"
           "ElementDataFile = LOCAL\n").encode() + vectors)


# --- cases of other programs --------------------------------------------------------------------------------------

GENERAL = {"Number_of_time_steps": 2, "Time_step_size": "1e-3", "Spectral_radius_of_infinite_time_step": 0.5,
           "Continue_previous_simulation": 0, "Increment_in_saving_VTK_files": 5, "Verbose": 1}
INP_NAMES = {"LS": "LS type", "Limiting_high_shear_rate_viscosity": "Limiting high shear-rate viscosity",
             "Power_law_index": "Power-law index (n)"}


def peer_mesh(name, faces, more=()):
    return [("Add_mesh", name, [("Mesh_file_path", "%s/volume.vtu" % name)] +
             [("Add_face", face, [("Face_file_path", "%s/%s.vtp" % (name, face))]) for face in faces] + list(more))]


def condition(face, **keys):
    return ("Add_BC", face, list(keys.items()))


def peer_flow():
    return peer_mesh("lumen", ["inlet", "outlet", "side"], [("Mesh_scale_factor", 0.1)]) + [("Add_equation", "fluid", [
        ("Tolerance", "1e-5"), ("Density", 1.06), ("Viscosity", "Carreau-Yasuda", [
            ("Limiting_high_shear_rate_viscosity", 0.022), ("Limiting_low_shear_rate_viscosity", 0.22),
            ("Shear_rate_tensor_multiplier", 0.11), ("Shear_rate_tensor_exponent", 0.644), ("Power_law_index", 0.392)]),
        ("LS", "NS", [("Tolerance", "1e-3"), ("NS_GM_tolerance", "1e-3")]),
        ("Output", "Spatial", [("Velocity", "1"), ("WSS", "1")]),
        condition("inlet", Type="Dir", Time_dependence="Unsteady", Temporal_values_file_path="in.flow",
                  Profile="Parabolic", Impose_flux="1"),
        ("Add_BC", "outlet", [("Type", "Neu"), ("Time_dependence", "RCR"), ("RCR_values", "", [
            ("Proximal_resistance", 121), ("Capacitance", "1.5e-5"), ("Distal_resistance", 1212)])]),
        condition("side", Type="Dir", Value="0.0")])]


def peer_fsi():
    fibres = [("Domain", 1), ("Fiber_direction", "(0.7, 0.7, 0)"), ("Fiber_direction", "(0.7, -0.7, 0)")]
    return peer_mesh("lumen", ["in", "out", "side"], [("Domain", 0)]) + \
        peer_mesh("wall", ["start", "end", "inner", "outer"], fibres) + [
            ("Add_projection", "inner", [("Project_from_face", "side")]),
            ("Add_equation", "FSI", [
                ("Tolerance", "1e-6"), ("Max_iterations", 7),
                ("Domain", "0", [("Equation", "fluid"), ("Density", 1.0), ("Viscosity", "Constant", [("Value", 0.04)])]),
                ("Domain", "1", [("Equation", "ustruct"), ("Density", 1.2), ("Elasticity_modulus", "1e6"),
                                 ("Poisson_ratio", 0.5), ("Constitutive_model", "HGO", [
                                     ("a4", "1e5"), ("b4", 5), ("a6", "1e5"), ("b6", 5), ("kappa", 0.1)])]),
                condition("in", Type="Neu", Value="5.0e4"),
                condition("start", Type="Dir", Value="0.0", Effective_direction="(0, 0, 1)"),
                condition("outer", Type="Robin", Stiffness="1e5", Damping="10")]),
            ("Add_equation", "mesh", [("Poisson_ratio", 0.3), condition("in", Type="Dir", Value="0.0")])]


def peer_loads():
    """A wall with domains in a list, fibres in files, and loads and motions of all kinds."""
    mesh = [("Domain_file_path", "domains.dat"), ("Fiber_direction_file_path", "f1.vtu"),
            ("Fiber_direction_file_path", "f2.vtu"), ("Initial_displacements_file_path", "u.vtu")]
    law = [("Density", 1.2), ("Elasticity_modulus", "1e6"), ("Constitutive_model", "HGO", [
        ("a4", "1e5"), ("b4", 5), ("a6", "1e5"), ("b6", 5), ("kappa", 0.1)])]
    return peer_mesh("wall", ["a", "b", "c", "d", "e", "f"], mesh) + [("Add_equation", "struct", [
        ("Tolerance", "1e-6"), ("Domain", "1", law), ("Domain", "2", law),
        condition("a", Type="Dir", Value="0.1", Profile="Parabolic"),
        condition("b", Type="Dir", Time_dependence="General", Temporal_and_spatial_values_file_path="v.dat"),
        condition("c", Type="Trac", Traction_values_file_path="t.vtp", Traction_multiplier="0.5"),
        condition("d", Type="Trac", Time_dependence="Unsteady", Temporal_values_file_path="t.dat", Ramp_function="1"),
        condition("e", Type="Neu", Value="3.0", Profile="User_defined", Spatial_profile_file_path="s.dat",
                  Impose_flux="1"),
        condition("e", Type="Dir", Value="0.0", Effective_direction="(1, 0, 0)"),
        condition("f", Type="Neu", Time_dependence="Spatial", Spatial_values_file_path="p.vtp")])]


def as_xml(entries):
    attribute = {"Add_equation": "type", "Domain": "id", "Viscosity": "model", "LS": "type", "Output": "type",
                 "Constitutive_model": "type"}
    text = ""
    for entry in entries:
        if len(entry) == 2:
            text += "<%s> %s </%s>\n" % (entry[0], entry[1], entry[0])
        else:
            label = ' %s="%s"' % (attribute.get(entry[0], "name"), entry[1]) if entry[1] else ""
            text += "<%s%s>\n%s</%s>\n" % (entry[0], label, as_xml(entry[2]), entry[0])
    return text


def as_inp(entries):
    text = ""
    for entry in entries:
        key = INP_NAMES.get(entry[0], entry[0].replace("_", " "))
        if entry[0] == "RCR_values":
            text += "RCR values: (%s)\n" % ", ".join(str(value).replace("e", "D") for _, value in entry[2])
        elif len(entry) == 2:
            text += "%s: %s\n" % (key, entry[1])
        else:
            text += "%s: %s {\n%s}\n" % (key, entry[1], as_inp(entry[2]))
    return text


def peer_corpus():
    for name, entries in (("flow", peer_flow()), ("fsi", peer_fsi()), ("loads", peer_loads())):
        write("peer/xml/%s.xml" % name, "<?xml version=\"1.0\"?>\n<svMultiPhysicsFile version=\"0.1\">\n" + as_xml(
            [("GeneralSimulationParameters", "", list(GENERAL.items()))] + entries) + "</svMultiPhysicsFile>\n")
        write("peer/inp/%s.inp" % name, "# general\n" + as_inp(list(GENERAL.items()) + entries))
    write("peer/zerod/outlets.json", json.dumps({
        "boundary_conditions": [{"bc_name": "R", "bc_type": "RCR", "bc_values": {"Rp": 121, "Rd": 1212, "C": 1e-4}}],
        "external_solver_coupling_blocks": [{"name": "outlet", "type": "FLOW", "connected_block": "R"}]}, indent=1))


# --- tables, cases ------------------------------------------------------------------------------------------------

def table_corpus():
    write("table/csv/numbers.csv", "# measured\ntime [s],flow [ml/s]\n0,1.5\n0.1,-2e-3\n\n0.2,3\n")
    write("table/waveform/two_columns.csv", "# measured\nt_s,Q_ml_per_s\n0,1.5\n0.1,20\n0.15,12\n0.2,1.5\n")
    write("table/waveform/quoted.csv", '"t","flow"\r\n0,1\r\n+0.5,2\r\n.7,3\r\n1,1\r\n')
    write("table/waveform/simvascular.flow", "5 3\n0 -1\n0.25 -2\n0.5 -3\n0.75 -2\n1 -1\n")
    write("table/waveform/coefficients.fcs", "0.0 1.0\n2.0 0.5\n3\n-1.5 0\n0.5 -0.25\n0 1e-3\n")
    write("table/openings/names.csv",
          "name,centre_x,centre_y,centre_z,area\ninlet,0,0,0,1\nleft_iliac,1.5,-2,3e1,2\n# end\n")
    write("table/series/lumen.hdf.series",
          '{\n  "file-series-version": "1.0",\n  "files": [\n    {"name": "lumen_000000.hdf", "time": 0},\n'
          '    {"name": "lumen_000004.hdf", "time": 0.5}\n  ]\n}\n')


def without_comments(path):
    lines = path.read_text().splitlines()
    return "\n".join(line.split("  #")[0].rstrip() for line in lines if not line.lstrip().startswith("#")) + "\n"


conditions = """title: Conditions of many kinds
analysis: fsi
meshes:
  gmsh: {file: cubes.msh, regions: {lumen: lumen, wall: wall}}
  length_unit: mm
  interface: {lumen: [lumen_interface], wall: [wall_interface]}
fluid:
  density: 1060 kg/m^3
  viscosity: {carreau_yasuda: {zero_shear: 56 mPa s, infinite_shear: 3.45 mPa s, time: 3.313 s, power: 0.3568, a: 2}}
wall: {density: 1120 kg/m^3, material: {mooney_rivlin: {c10: 30 kPa, c01: 10 kPa, poisson_ratio: 0.49}}}
boundary:
  lumen_inlet: {flow: {table: {file: inflow.csv, time_unit: s, unit: ml/s}}}
  lumen_side: no_slip
  wall_outside: {support: {stiffness: 1e7 N/m^3}}
time: {step: 1 ms, steps: 10, rho_infinity: 0.5}
output: {directory: results, every: 2, units: {pressure: mmHg}}
"""


def yaml_corpus():
    for name in ("pulse_tube", "fibre_tube", "dissection"):
        write("yaml/case/%s.yaml" % name, without_comments(examples / name / "case.yaml"))
    write("yaml/mesh/parametric.yaml", without_comments(examples / "dissection/mesh.yaml"))
    write("yaml/mesh/image.yaml",
          without_comments(examples / "dissection/image.yaml").replace("../../out/dissection/scan.nrrd", "scan.nrrd"))
    write("yaml/mesh/surfaces.yaml",
          "title: Surfaces\ngeometry:\n  surfaces:\n    lumen: lumen.stl\n    openings: openings.csv\n"
          "    length_unit: mm\n    wall: {per_radius: 0.17}\nsize: {edge: 2 mm}\noutput: out\n")
    write("yaml/material/dispersed.yaml", without_comments(examples / "material_dfd/material.yaml"))
    write("yaml/fibres/dissection.yaml",
          without_comments(examples / "dissection/fibres.yaml").replace("../../out/dissection/mesh", "sv"))
    write("yaml/beside/inflow.csv", (examples / "dissection/inflow.csv").read_text())
    write("yaml/beside/strips.csv", (examples / "material_dfd/strips.csv").read_text())
    write("yaml/beside/scan.nrrd", nrrd("spacings: 1 1 1\ntype: uchar\nencoding: ascii", text_labels.encode()))
    write("yaml/beside/lumen.stl", stl(side))
    write("yaml/beside/openings.csv", "name,centre_x,centre_y,centre_z\ninlet,0.5,0.5,0\noutlet,0.5,0.5,1\n")
    write("yaml/beside/cubes.msh", gmsh(0, False))
    for part in ("lumen", "wall"):
        write("yaml/beside/sv/%s/mesh-complete.mesh.vtu" % part, volume("ascii"))
        write("yaml/beside/sv/%s/mesh-surfaces/inlet.vtp" % part, face(inlet, "ascii"))


# --- what stages leave --------------------------------------------------------------------------------------------

def checkpoint():
    header = json.dumps({
        "nodes": 8, "case_hash": 11, "mesh_hash": 42, "step": 19, "time": 0.3, "dt": 0.01, "residual_reference": 1.5,
        "velocity_reference": 2.5, "outlets": [{"face": "outlet", "state": [1e-5, 1e4], "pressure": 1.1e4}],
        "grid": {"base_time": 0.1, "base_step": 2, "nominal": 0.01, "done": 7, "part": 5, "level": 2}},
        separators=(",", ":")).encode()
    parts = [b"tunicaCP", struct.pack("<Q", 1), struct.pack("<Q", len(header)), header]
    parts += [struct.pack("<32d", *(0.1 * k + shift for k in range(32))) for shift in range(4)]
    value = 14695981039346656037
    for part in parts:
        for at in range(0, len(part), 8):
            word = struct.unpack("<Q", part[at:at + 8].ljust(8, b"\0"))[0]
            value = (value ^ word) * 1099511628211 % 2**64
            value ^= value >> 32
    return b"".join(parts) + struct.pack("<Q", value)


def artifacts_corpus():
    write("artifacts/checkpoint/step_00000019.checkpoint", checkpoint())
    write("artifacts/start/step_00000019.checkpoint", checkpoint())
    for how in ("ascii", "raw"):
        write("artifacts/prestress/stress_%s.vtu" % how,
              volume(how, [("prestress", [0.5 * k for k in range(36)], "Float64", "d", 6)]))
        write("artifacts/prestress/stretch_%s.vtu" % how,
              volume(how, [("prestress", [1, 0, 0, 0, 1, 0, 0, 0, 1] * 6, "Float64", "d", 9)]))
        stress = [0.5 * k for k in range(36)]
        names = ["prestress"] + ["prestress %d" % k for k in range(1, 5)]
        write("artifacts/prestress_quadratic/stress_%s.vtu" % how,
              quadratic_volume(how, [(name, stress, "Float64", "d", 6) for name in names]))
    rcr = "{rcr: {proximal: 1e8 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1e9 Pa s/m^3, distal_pressure: 0 Pa, " \
        "initial_pressure: 1e4 Pa}}"
    write("artifacts/outlets/outlets.yaml",
          "# Outlets found by `tunica tune`.\nsystolic: 16000 Pa\ndiastolic: 10000 Pa\ndistal_share: 0.9\n"
          "distal_pressure: 0 Pa\nfractions:\n  left: 0.4\n  right: 0.6\nboundary:\n  left: %s\n  right: %s\n" % (rcr, rcr))
    write("artifacts/history/steps.csv", "step,time [s],flow [ml/s]\n1,0.1,2.5\n2,0.2,3\n3,0.3,4\n")
    write("artifacts/manifest/manifest.json", json.dumps({
        "case": {"file": "case.yaml", "hash": "000000000000000b", "text": "title: none"},
        "mesh": {"hash": "000000000000002a", "nodes": 8, "elements": 6, "regions": [{"name": "lumen", "elements": 6}]},
        "runs": [{"started": "2024-01-01T00:00:00Z", "ended": "", "status": "completed", "last_step": 3}]}, indent=2))


if __name__ == "__main__":
    mesh_corpus()
    surface_corpus()
    image_corpus()
    peer_corpus()
    table_corpus()
    yaml_corpus()
    artifacts_corpus()
