"""What a scene of the truth tests and of tests/error says: one record of numbers, of which ours.py, mitsuba_side.py, cycles_side.py
and povray_side.py each write their own renderer's scene. Right-handed, Z up, linear RGB, angles in degrees, as in ASCII/README.md."""
from dataclasses import dataclass, field
from typing import Optional
import numpy as np


@dataclass
class Material:
    """One way in which a surface scatters light; `kind` is one of
    diffuse (color or texture), mirror (color), glass (ior, smooth), glossy (color of every angle, roughness: GGX), and, of
    Cycles alone, rough_glass (ior, roughness),
    refraction (ior, roughness), metal (color, edge_tint, roughness, anisotropy, rotation), plastic (color, ior, roughness),
    oren_nayar (color, roughness), translucent (color)."""
    kind: str = "diffuse"
    color: tuple = (0.7, 0.7, 0.7)
    texture: Optional[str] = None  # name of a picture of the scene, by uv
    ior: float = 1.5
    roughness: float = 0.0
    edge_tint: tuple = (1, 1, 1)
    anisotropy: float = 0.0
    rotation: float = 0.0  # in turns
    emission: tuple = (0, 0, 0)  # radiance; of the front alone, but of both sides where the peer is cycles
    opacity: float = 1.0


@dataclass
class Mesh:
    points: np.ndarray
    faces: np.ndarray
    uvs: Optional[np.ndarray] = None  # one per point
    normals: Optional[np.ndarray] = None  # one per point; without them it is flat


@dataclass
class Shape:
    """kind: rectangle and cube ([-1,1] in x, y and z), sphere and disk (radius 1), ground (z = 0, as far as one sees), or mesh.
    `mesh` names one of the scene. A ground has `other` on every second of the unit squares of its x and y. While the shutter
    is open a shape moves by `motion`, evenly."""
    kind: str
    material: str
    place: np.ndarray = field(default_factory=lambda: np.eye(4))
    mesh: Optional[str] = None
    other: Optional[str] = None  # a material
    motion: Optional[tuple] = None


@dataclass
class Lamp:
    """point and spot: `light` is W/sr. sun: W/m2. sphere, disk and rectangle: radiance, and they can be seen: in Mitsuba's
    scenes they are bodies, in those of Cycles light that hides nothing; in those of all of them no ray may tell. They shine along -Z of `place`; a disk has radius 1
    and a rectangle is [-1,1]^2 there."""
    kind: str
    light: tuple
    place: np.ndarray = field(default_factory=lambda: np.eye(4))
    radius: float = 0.0
    angle: float = 0.0  # sun: full angle of its disk; spot: full angle of its cone
    blend: float = 0.0


@dataclass
class Scene:
    name: str
    peer: str  # mitsuba, cycles, or all: what is the same in every renderer; see Material and Lamp
    what: str
    eye: tuple
    target: tuple
    fov: float
    materials: dict
    shapes: list
    meshes: dict = field(default_factory=dict)
    lamps: list = field(default_factory=list)
    pictures: dict = field(default_factory=dict)  # arrays [height, width, 3], row 0 at the top
    background: tuple = (0, 0, 0)
    sky: Optional[np.ndarray] = None  # equirectangular [height, width, 3], row 0 at the zenith
    shared: bool = False  # meshes are written once and placed as instances
    depth: int = 8  # bounces after the camera ray
    diffuse_depth: Optional[int] = None  # of these, the most that are diffuse; None: all
    integrator: str = "path"  # of ours
    aperture: float = 0.0  # radius of the lens
    focus: float = 1.0  # distance of what is sharp, along the view axis
    size: int = 64  # pixels of a side
    spp: int = 64
    peer_spp: int = 64
    seeds: int = 16
    block: int = 4  # pixels of a block's side
    note: str = ""  # what is left out or unlike, and why
    hide: list = field(default_factory=list)  # boxes of pixels x0, y0, x1, y1 left out of the tests


# Transforms, as matrices that multiply columns.

def move(x, y, z):
    m = np.eye(4)
    m[:3, 3] = x, y, z
    return m


def scale(x, y=None, z=None):
    y, z = (x if y is None else y), (x if z is None else z)
    return np.diag([x, y, z, 1.0])


def turn(degrees, x, y, z):
    a = np.array([x, y, z], float) / np.linalg.norm([x, y, z])
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    m = np.eye(4)
    m[:3, :3] = np.eye(3) * c + s * k + (1 - c) * np.outer(a, a)
    return m


def aim(eye, target):
    """Puts a thing at `eye`, its -Z towards `target`, its +Y as far up as that goes."""
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    up = (0, 0, 1) if abs(back[2]) < 0.999 else (0, 1, 0)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = right, np.cross(back, right), back, eye
    return m


# Meshes.

def ring(major, minor, around=48, across=24):
    """A torus about z."""
    a, b = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
    out = major + minor * np.cos(b)
    points = np.stack([out * np.cos(a), out * np.sin(a), minor * np.sin(b)], -1).reshape(-1, 3)
    normals = np.stack([np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    at = lambda u, v: ((u % around) * across + v % across).ravel()
    p, q, r, s = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
    return Mesh(points, np.concatenate([np.stack([p, q, r], 1), np.stack([p, r, s], 1)]), None, normals)


def ball(rows=24, columns=48):
    """A sphere of radius 1, as triangles, with uv and smooth normals."""
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")
    t, f = v * np.pi, u * 2 * np.pi
    points = np.stack([np.sin(t) * np.cos(f), np.sin(t) * np.sin(f), np.cos(t)], -1).reshape(-1, 3)
    uvs = np.stack([u, 1 - v], -1).reshape(-1, 2)
    faces = []
    for r in range(rows):
        for c in range(columns):
            a, b = r * (columns + 1) + c, r * (columns + 1) + c + 1
            d, e = a + columns + 1, b + columns + 1
            if r > 0: faces.append((a, d, b))
            if r < rows - 1: faces.append((b, d, e))
    return Mesh(points, np.array(faces), uvs, points.copy())


def ground(far=1e5):
    """z = 0 in squares around each other, so that what is near is exact in floats; uv are halves of x and y."""
    halves, points, faces = [4.0], [], []
    while halves[-1] < far: halves.append(halves[-1] * 8)
    for h in halves: points += [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)]
    faces += [(0, 1, 2), (0, 2, 3)]
    for k in range(len(halves) - 1):
        for i in range(4):
            a, b = 4 * k + i, 4 * k + (i + 1) % 4
            faces += [(a, a + 4, b + 4), (a, b + 4, b)]
    points = np.array(points, float)
    return Mesh(points, np.array(faces), points[:, :2] / 2)


def flat(mesh):
    return Mesh(mesh.points, mesh.faces, mesh.uvs, None)


def square():
    """[-1,1]^2 in z = 0 with uv from 0 to 1, seen from +z."""
    points = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
    return Mesh(points, np.array([(0, 1, 2), (0, 2, 3)]), (points[:, :2] + 1) / 2)


def box():
    """[-1,1]^3, outward."""
    points = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Mesh(points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))


def scattered(count, size, low, high, seed):
    """Small triangles with corners on spheres of radius `size`, turned at random in a box."""
    random = np.random.default_rng(seed)
    centres = random.uniform(low, high, (count, 3))
    corners = random.normal(size=(count, 3, 3))
    corners *= size / np.linalg.norm(corners, axis=2, keepdims=True)
    return Mesh((centres[:, None] + corners).reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def surface(mesh):
    a, b, c = (mesh.points[mesh.faces[:, i]] for i in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
