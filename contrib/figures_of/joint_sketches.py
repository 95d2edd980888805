"""Sketches of all kinds of joints and contacts for joints_at_a_glance.md. Parts: names of sketches.

Grey is body A, blue is body B, red what may move or what acts between them."""

import math

from figures_of.common import doc, np


WIDTH, HEIGHT, SCALE = 180, 130, 36
A, B, RED, LIGHT = ("#e3e6ea", "#6b727c"), ("#cfe0f3", "#1f5fa8"), "#d1495b", ("#f3f4f6", "#a9afb8")
AZIMUTH, ELEVATION = math.radians(-62), math.radians(22)
TO_EYE = np.array([math.cos(ELEVATION) * math.cos(AZIMUTH), math.cos(ELEVATION) * math.sin(AZIMUTH), math.sin(ELEVATION)])
RIGHT = np.array([-math.sin(AZIMUTH), math.cos(AZIMUTH), 0])
UP = np.cross(TO_EYE, RIGHT)
X, Y, Z, O = np.eye(3)[0], np.eye(3)[1], np.eye(3)[2], np.zeros(3)


def at(x, y, z=0.0):
    return np.array([x, y, z], float)


def unit(v):
    v = np.array(v, float)
    return v / np.linalg.norm(v)


def across(axis):
    """Two directions across an axis."""
    axis = unit(axis)
    first = unit(np.cross(axis, Z if abs(axis[2]) < 0.9 else X))
    return first, np.cross(axis, first)


def hull(points):
    """Convex hull in the plane, counterclockwise."""
    points = sorted(set((round(p[0], 2), round(p[1], 2)) for p in points))

    def chain(row):
        kept = []
        for p in row:
            while len(kept) > 1 and ((kept[-1][0] - kept[-2][0]) * (p[1] - kept[-2][1])
                                     - (kept[-1][1] - kept[-2][1]) * (p[0] - kept[-2][0])) <= 0:
                kept.pop()
            kept.append(p)
        return kept[:-1]

    return chain(points) + chain(points[::-1])


class Sketch:
    """A drawing in axes x to the right, y away, z up; one unit is SCALE pixels. What is drawn later covers what was before."""

    def __init__(self, centre=(0, 0, 0)):
        self.lines, self.centre = [], np.array(centre, float)

    def place(self, p):
        p = np.array(p, float) - self.centre
        return WIDTH / 2 + SCALE * p @ RIGHT, HEIGHT / 2 - SCALE * p @ UP

    # in the plane of the picture
    def path(self, points, stroke, fill="none", width=1.3, closed=False, dashed=False):
        text = " ".join("%.4g,%.4g" % tuple(p) for p in points)
        self.lines.append('<%s points="%s" fill="%s" stroke="%s" stroke-width="%g"%s/>' % (
            "polygon" if closed else "polyline", text, fill, stroke, width, ' stroke-dasharray="4 3"' if dashed else ""))

    def text(self, p, words, colour="#333", size=11):
        x, y = self.place(p)
        self.lines.append('<text x="%.4g" y="%.4g" font-size="%g" fill="%s">%s</text>' % (x, y, size, colour, words))

    def dot(self, p, colour="#333", size=2.2):
        x, y = self.place(p)
        self.lines.append('<circle cx="%.4g" cy="%.4g" r="%g" fill="%s"/>' % (x, y, size, colour))

    def head(self, tip, before, colour=RED, size=6):
        (x, y), (u, v) = tip, before
        n = math.hypot(x - u, y - v) or 1
        c, s = (x - u) / n, (y - v) / n
        self.path([(x, y), (x - size * c + 0.45 * size * s, y - size * s - 0.45 * size * c),
                   (x - size * c - 0.45 * size * s, y - size * s + 0.45 * size * c)], colour, colour, 0.5, True)

    # in space
    def line(self, *points, colour="#333", width=1.3, dashed=False):
        self.path([self.place(p) for p in points], colour, width=width, dashed=dashed)

    def arrow(self, p, q, both=True, colour=RED):
        a, b = self.place(p), self.place(q)
        self.path([a, b], colour, width=1.6)
        self.head(b, a, colour)
        if both:
            self.head(a, b, colour)

    def turn(self, centre, axis, radius, start=0.0, end=270.0, both=True, colour=RED):
        u, v = across(axis)
        row = [self.place(centre + radius * (math.cos(math.radians(a)) * u + math.sin(math.radians(a)) * v))
               for a in np.linspace(start, end, 25)]
        self.path(row, colour, width=1.6)
        self.head(row[-1], row[-3], colour)
        if both:
            self.head(row[0], row[2], colour)

    def circle(self, centre, axis, radius, n=28):
        u, v = across(axis)
        return [centre + radius * (math.cos(a) * u + math.sin(a) * v) for a in np.linspace(0, 2 * math.pi, n, endpoint=False)]

    def face(self, corners, look=A, dashed=False):
        self.path([self.place(p) for p in corners], look[1], look[0], closed=True, dashed=dashed)

    def box(self, centre, size, look=A, axes=None):
        axes = np.eye(3) if axes is None else np.array(axes)
        half = [axes[i] * size[i] / 2 for i in range(3)]
        for i in range(3):
            towards = half[i] if half[i] @ TO_EYE > 0 else -half[i]
            j, k = (i + 1) % 3, (i + 2) % 3
            self.face([centre + towards + a * half[j] + b * half[k] for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))], look)

    def cylinder(self, p, q, radius, look=A, hole=0.0):
        p, q = np.array(p, float), np.array(q, float)
        axis = unit(q - p)
        ends = [self.circle(p, axis, radius), self.circle(q, axis, radius)]
        self.path(hull([self.place(x) for x in ends[0] + ends[1]]), look[1], look[0], closed=True)
        near = 1 if axis @ TO_EYE > 0 else 0
        self.face(ends[near], look)
        if hole:
            self.face(self.circle((p, q)[near], axis, hole), ("white", look[1]))

    def bar(self, p, q, look=A, radius=0.09):
        self.cylinder(p, q, radius, look)

    def ball(self, centre, radius, look=B):
        x, y = self.place(centre)
        self.lines.append('<circle cx="%.4g" cy="%.4g" r="%.4g" fill="%s" stroke="%s" stroke-width="1.3"/>'
                          % (x, y, SCALE * radius, look[0], look[1]))
        self.path([(x + SCALE * radius * 0.6 * math.cos(a), y + SCALE * radius * 0.6 * math.sin(a))
                   for a in np.linspace(3.4, 4.5, 7)], "white", width=1.6)

    def plane(self, centre, u, v, look=LIGHT):
        u, v = np.array(u, float), np.array(v, float)
        self.face([centre + u + v, centre + u - v, centre - u - v, centre - u + v], look)

    def ground(self, p, along=X, down=-Z, length=0.7):
        """A line with hatches under a point."""
        along, down = unit(along), unit(down)
        self.line(p - length / 2 * along, p + length / 2 * along, colour=A[1], width=1.6)
        for s in np.linspace(-0.45, 0.4, 6):
            q = p + s * length * along
            self.line(q, q + 0.14 * down - 0.1 * along, colour=A[1], width=0.8)

    def spring(self, p, q, turns=5, wide=0.13, colour=RED):
        (x, y), (u, v) = self.place(p), self.place(q)
        n = math.hypot(u - x, v - y)
        c, s, w = (u - x) / n, (v - y) / n, SCALE * wide
        row = [(x, y), (x + 0.12 * n * c, y + 0.12 * n * s)]
        for i in range(2 * turns):
            d, side = n * (0.12 + 0.76 * (i + 0.5) / (2 * turns)), w if i % 2 else -w
            row.append((x + d * c - side * s, y + d * s + side * c))
        self.path(row + [(x + 0.88 * n * c, y + 0.88 * n * s), (u, v)], colour, width=1.4)

    def curve(self, function, start, end, n=30, **options):
        self.line(*[function(s) for s in np.linspace(start, end, n)], **options)

    def tube(self, function, start, end, radius=0.07, look=A, n=24):
        """A bent rod, as a thick line with edges."""
        row = [self.place(function(s)) for s in np.linspace(start, end, n)]
        self.path(row, look[1], width=2 * SCALE * radius + 2.4)
        self.path(row, look[0], width=2 * SCALE * radius)

    def axes(self, x, y):
        """Of a chart: its corner is x, y in pixels."""
        self.path([(x, 20), (x, y), (WIDTH - 12, y)], "#333", width=1.2)

    def write(self, name):
        head = '<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" viewBox="0 0 %d %d" font-family="sans-serif" ' \
               'stroke-linejoin="round" stroke-linecap="round">' % (WIDTH, HEIGHT, WIDTH, HEIGHT)
        doc("pictures/joints/" + name.replace(" ", "_") + ".svg").write_text(
            "\n".join([head, '<rect width="100%" height="100%" fill="white"/>'] + self.lines + ["</svg>", ""]))


def shaft_in_sleeve(s, moves, turns, thread=False):
    """A blue shaft along x in a grey sleeve."""
    s.bar(at(-1.9, 0), at(-0.7, 0), B, 0.2)
    s.cylinder(at(-0.7, 0), at(0.7, 0), 0.42, A, 0.22)
    s.ground(at(0, -0.42, -0.55))
    s.bar(at(0.7, 0), at(1.9, 0), B, 0.2)
    if thread:
        for x in np.arange(0.85, 1.9, 0.2):
            s.curve(lambda a: at(x + 0.1 * a / math.pi, -0.2 * math.sin(a), 0.2 * math.cos(a)), 0, math.pi, 8, colour=B[1], width=1)
    if moves:
        s.arrow(at(0.9, 0, 0.62), at(2.0, 0, 0.62))
    if turns:
        s.turn(at(-1.5, 0), X, 0.42, -30, 210)


def revolute(s):
    s.box(at(-0.9, 0), (1.5, 0.6, 0.24), A)
    s.cylinder(at(0, 0, -0.35), at(0, 0, 0.2), 0.36, A)
    s.box(at(0.95, 0, 0.32), (1.6, 0.5, 0.22), B)
    s.cylinder(at(0, 0, 0.2), at(0, 0, 0.46), 0.36, B)
    s.line(at(0, 0, 0.46), at(0, 0, 1.1), dashed=True)
    s.turn(at(0, 0, 0.85), Z, 0.5, 200, 430)


def prismatic(s):
    s.box(at(0, 0, 0), (3.4, 0.34, 0.34), A)
    s.box(at(-0.1, 0, 0.1), (0.9, 0.7, 0.66), B)
    s.arrow(at(-1.0, 0, 0.8), at(0.9, 0, 0.8))


def screw(s):
    shaft_in_sleeve(s, True, True, thread=True)


def cylindrical(s):
    shaft_in_sleeve(s, True, True)


def planar(s):
    s.plane(O, 1.7 * X, 1.2 * Y)
    s.cylinder(O, at(0, 0, 0.35), 0.6, B)
    s.arrow(at(0.7, 0, 0.1), at(1.6, 0, 0.1), False)
    s.arrow(at(0, 0.62, 0.1), at(0, 1.25, 0.1), False)
    s.turn(at(0, 0, 0.6), Z, 0.4, 150, 420)


def spherical(s):
    s.bar(at(-1.8, 0, -0.5), at(-0.3, 0, -0.1), A, 0.12)
    s.ball(O, 0.46, A)
    s.ball(at(0.06, -0.1, 0.03), 0.36, B)
    s.bar(at(0.35, -0.1, 0.12), at(1.7, -0.1, 0.6), B, 0.1)
    s.turn(at(1.15, -0.1, 0.4), at(1.35, 0, 0.48), 0.34, -60, 200)
    s.turn(O, Y, 0.8, 235, 305)


def cross_joint(s, skew):
    tilt = unit(at(0, math.cos(0.45), math.sin(0.45))) if skew else Z
    s.bar(at(-2.0, 0), at(-0.75, 0), A, 0.13)
    s.tube(lambda t: at(-0.75 * abs(math.cos(t)) ** 0.6, 0.62 * math.sin(t), 0), -math.pi / 2, math.pi / 2, 0.07, A)
    s.bar(at(0, -0.62), at(0, 0.62), ("white", "#333"), 0.06)
    s.bar(-0.62 * tilt, 0.62 * tilt, ("white", "#333"), 0.06)
    s.tube(lambda t: at(0.75 * abs(math.cos(t)) ** 0.6, 0, 0) + 0.62 * math.sin(t) * tilt, -math.pi / 2, math.pi / 2, 0.07, B)
    s.bar(at(0.75, 0), at(2.0, 0), B, 0.13)
    s.turn(at(0, -0.8, 0), Y, 0.3, 40, 320)
    s.turn(0.85 * tilt, tilt, 0.3, 130, 420)


def universal(s):
    cross_joint(s, False)


def skew_universal(s):
    cross_joint(s, True)


def constant_velocity(s):
    bend = unit(at(1, 0, 0.75))
    s.bar(at(-2.0, 0, -0.4), at(-0.3, 0, -0.4), A, 0.13)
    s.cylinder(at(-0.35, 0, -0.4), at(0.25, 0, -0.4), 0.45, A)
    s.ball(at(0.2, 0, -0.4), 0.32, B)
    s.bar(at(0.2, 0, -0.4) + 0.28 * bend, at(0.2, 0, -0.4) + 1.9 * bend, B, 0.12)
    s.turn(at(-1.3, 0, -0.4), X, 0.36, -40, 220, False)
    s.turn(at(0.2, 0, -0.4) + 1.35 * bend, bend, 0.36, -40, 220, False)
    s.text(at(-1.6, 0, -1.15), "ω", RED, 13)
    s.text(at(1.75, 0, 0.35), "ω", RED, 13)


def in_line(s):
    s.bar(at(-1.9, 0), at(1.9, 0), A, 0.07)
    s.ball(O, 0.3)
    s.arrow(at(-1.1, 0, 0.55), at(1.1, 0, 0.55))
    s.turn(O, at(0, 1, 0.3), 0.62, 200, 340)


def in_plane(s):
    s.plane(at(0, 0, -0.2), 1.7 * X, 1.2 * Y)
    s.ball(at(0, 0, 0.05), 0.26)
    s.arrow(at(0.4, 0, -0.1), at(1.5, 0, -0.1), False)
    s.arrow(at(0, 0.4, -0.1), at(0, 1.15, -0.1), False)
    s.turn(at(0, 0, 0.05), at(0, 1, 0.2), 0.5, 200, 340)


def rigid(s):
    s.box(at(-0.95, 0), (1.7, 0.7, 0.5), A)
    s.box(at(0.85, 0), (1.7, 0.5, 0.4), B)
    for z in np.linspace(-0.16, 0.16, 4):
        s.line(at(-0.1, -0.35, z), at(0.1, -0.25, z + 0.08), width=1.6)


def flexible_joint(s):
    s.box(at(0, 0, -0.75), (2.2, 1.0, 0.22), A)
    for x in (-0.75, 0.0, 0.75):
        s.spring(at(x, 0, -0.64), at(x, 0, 0.24))
    s.box(at(0, 0, 0.42), (2.0, 0.9, 0.34), B)
    s.turn(at(0, 0, 0.78), Z, 0.35, 150, 420)
    s.arrow(at(1.3, 0, -0.3), at(1.3, 0, 0.6))


def distance(s):
    s.ground(at(-1.5, 0, -0.5))
    s.line(at(-1.4, 0, -0.5), at(1.2, 0, 0.5), width=3, colour="#555")
    s.dot(at(-1.4, 0, -0.5), A[1], 4)
    s.box(at(1.5, 0, 0.6), (0.7, 0.5, 0.5), B)
    s.dot(at(1.2, 0, 0.5), B[1], 4)
    s.text(at(-0.5, 0, 0.25), "L", size=13)
    s.turn(at(-1.4, 0, -0.5), Y, 2.9, -8, 14)


def gear(s):
    for x, r, look, n in ((-0.62, 0.62, A, 12), (0.58, 0.55, B, 11)):
        centre, row = at(x, 0), []
        for i in range(n):
            for part, radius in ((0, r - 0.07), (0.25, r + 0.08), (0.5, r + 0.08), (0.75, r - 0.07)):
                a = 2 * math.pi * (i + part) / n
                row.append(centre + radius * at(math.cos(a), 0, math.sin(a)))
        s.face(row, look)
        s.dot(centre, look[1], 3)
    s.turn(at(-0.62, -0.05), Y, 0.36, -60, 120, False)
    s.turn(at(0.58, -0.05), -Y, 0.32, 60, 240, False)


def spring(s):
    s.ground(at(-1.8, 0, 0), along=Z, down=-X)
    s.spring(at(-1.8, 0, 0.16), at(0.9, 0, 0.16), 7)
    s.line(at(-1.8, 0, -0.22), at(-0.6, 0, -0.22), colour=RED)
    s.box(at(-0.45, 0, -0.22), (0.5, 0.02, 0.24), ("white", RED))
    s.line(at(-0.4, 0, -0.22), at(0.9, 0, -0.22), colour=RED)
    s.box(at(1.3, 0, 0), (0.8, 0.6, 0.7), B)


def springs_in_fixed_axes(s):
    turned = (unit(at(1, 0, 0.35)), Y, unit(at(-0.35, 0, 1)))
    s.spring(at(-1.9, 0, 0), at(-0.4, 0, 0))
    s.spring(at(0, 0, -1.3), at(0, 0, -0.3))
    s.spring(at(0.75, 1.5, 0), at(0.12, 0.3, 0))
    s.box(O, (0.9, 0.7, 0.6), B, turned)
    s.ground(at(-1.9, 0, 0), along=Z, down=-X)
    s.ground(at(0, 0, -1.3))
    s.turn(O, Y, 1.05, -130, -50)


def point_on_curve(s):
    wire = lambda t: at(1.7 * t, 0, 0.75 * t * t - 0.55 + 0.25 * math.sin(3 * t))
    s.tube(wire, -1.05, 1.05, 0.03, A)
    s.ball(wire(0.35), 0.22)
    s.arrow(wire(-0.05) + 0.45 * Z, wire(0.85) + 0.4 * Z)


def rolling_ball(s):
    s.plane(at(0, 0, -0.55), 1.8 * X, 1.1 * Y)
    s.ball(O, 0.55)
    s.dot(at(0, -0.1, -0.55))
    s.turn(O, Y, 0.78, 200, 330, False)
    s.arrow(at(0.6, 0, -0.5), at(1.5, 0, -0.5), False)


def rolling_disc(s):
    s.plane(at(0, 0, -0.85), 1.8 * X, 1.2 * Y)
    axle = unit(at(0.25, -1, 0.45))
    centre = at(0, 0.1, -0.1)
    s.cylinder(centre - 0.07 * axle, centre + 0.07 * axle, 0.8, B)
    s.line(centre + 0.07 * axle, centre + 1.4 * axle, dashed=True)
    s.turn(centre + 0.1 * axle, axle, 0.55, 130, 330, False)


def knife_edge(s):
    s.plane(at(0, 0, -0.6), 1.9 * X, 1.2 * Y)
    s.curve(lambda t: at(1.6 * t, 0.5 * math.sin(1.5 * t) - 0.1, -0.6), -1, 0, colour=B[1], dashed=True, width=1)
    s.face([at(-0.7, -0.1, -0.35), at(-0.45, -0.1, -0.6), at(0.5, -0.1, -0.6), at(0.75, -0.1, -0.3), at(0.75, -0.1, 0.1), at(-0.7, -0.1, 0.1)], B)
    s.arrow(at(0.8, -0.1, -0.5), at(1.7, -0.1, -0.5), False)
    s.line(at(0, -0.15, -0.6), at(0, -1.0, -0.6), colour=RED, width=1.6)
    for a in (-0.12, 0.12):
        s.line(at(-0.12, -0.9 - a, -0.6), at(0.12, -0.9 + a, -0.6), colour=RED, width=1.8)
    s.turn(at(0, -0.1, 0.4), Z, 0.4, 150, 420)


BEAM = lambda t: at(1.9 * t, 0, 0.55 * t * t - 0.35)


def on_beam(s, draw, where=0.3):
    s.tube(BEAM, -1.05, 1.05, 0.09, A)
    p, q = BEAM(where), BEAM(where + 0.01)
    along = unit(q - p)
    draw(p, along, np.cross(along, Y))
    above = p + 0.75 * np.cross(along, Y)
    s.arrow(above - 0.55 * along, above + 0.55 * along)


def sliding_point(s):
    def draw(p, along, _):
        s.ball(p, 0.26)
        s.bar(p + at(0.05, -0.1, -0.22), p + at(0.5, -0.1, -0.95), B, 0.07)
        s.turn(p + at(0.35, -0.1, -0.68), unit(at(0.45, -0.3, -0.73)), 0.38, -60, 200)
    on_beam(s, draw)


def sliding_sleeve(s):
    def draw(p, along, _):
        s.cylinder(p - 0.35 * along, p + 0.35 * along, 0.3, B, 0.13)
        s.tube(BEAM, 0.5, 1.05, 0.09, A)
        s.turn(p - 0.75 * along, along, 0.36, -40, 220)
    on_beam(s, draw)


def sliding_prismatic(s):
    def draw(p, along, up):
        s.box(p, (0.75, 0.55, 0.5), B, (along, Y, np.cross(along, Y)))
    on_beam(s, draw)


def sliding_screw(s):
    def draw(p, along, _):
        for t in np.arange(-0.95, 1.0, 0.12):
            q = BEAM(t)
            s.line(q + at(-0.03, -0.09, -0.07), q + at(0.05, -0.09, 0.08), colour=A[1], width=1)
        s.cylinder(p - 0.25 * along, p + 0.25 * along, 0.36, B, 0.13)
        s.tube(BEAM, 0.45, 1.05, 0.09, A)
        s.turn(p - 0.7 * along, along, 0.36, -40, 220)
    on_beam(s, draw)


def buffer(s):
    s.tube(lambda t: at(1.9 * t, 0, 0.12 * t * t - 0.1), -1.05, 1.05, 0.07, A)
    for x in (-1.0, 1.0):
        s.cylinder(at(x - 0.28, 0, -0.08), at(x + 0.28, 0, -0.08), 0.28, B)
    s.spring(at(-0.72, 0, 0.02), at(0.2, 0, 0.02), 4)
    s.line(at(0.2, 0, -0.2), at(0.2, 0, 0.24), colour=RED, width=2)
    s.line(at(0.2, 0, 0.55), at(0.72, 0, 0.55), colour="#333", width=1)
    s.text(at(0.38, 0, 0.62), "g")


def stops(s):
    s.box(at(0, 0, -0.25), (3.4, 0.34, 0.2), A)
    s.box(at(-0.2, 0, 0.12), (0.7, 0.6, 0.5), B)
    for x, sign in ((-1.65, 1), (1.65, -1)):
        s.ground(at(x, 0, 0.15), along=Z, down=-sign * X)
        s.spring(at(x, 0, 0.15), at(x + sign * 0.6, 0, 0.15), 3)
        s.line(at(x + sign * 0.6, 0, -0.05), at(x + sign * 0.6, 0, 0.35), colour=RED, width=2)
    s.arrow(at(-0.75, 0, 0.75), at(0.35, 0, 0.75))


def backlash(s):
    s.face([at(-1.9, 0, -0.9), at(1.9, 0, -0.9), at(1.9, 0, -0.5), at(1.15, 0, -0.5), at(0.85, 0, 0.35), at(0.55, 0, 0.35),
            at(0.25, 0, -0.5), at(-0.75, 0, -0.5), at(-1.05, 0, 0.35), at(-1.35, 0, 0.35), at(-1.65, 0, -0.5), at(-1.9, 0, -0.5)], A)
    s.face([at(-1.4, -0.05, 0.9), at(1.0, -0.05, 0.9), at(1.0, -0.05, 0.55), at(0.35, -0.05, 0.55), at(0.02, -0.05, -0.3),
            at(-0.26, -0.05, -0.3), at(-0.62, -0.05, 0.55), at(-1.4, -0.05, 0.55)], B)
    s.arrow(at(0.1, -0.06, -0.05), at(0.38, -0.06, -0.05))
    s.arrow(at(-0.36, -0.06, -0.05), at(-0.88, -0.06, -0.05))


def bounce(s, p, up, length=0.5):
    """A red spring and damper as the sign of a contact."""
    s.spring(p, p + length * up, 3, 0.1)


def ball_on_plane(s):
    s.plane(at(0, 0, -0.5), 1.8 * X, 1.1 * Y)
    s.ball(at(0, 0, 0.25), 0.5)
    bounce(s, at(0, -0.1, -0.55), Z, 0.32)
    s.arrow(at(0.8, 0, -0.25), at(0.8, 0, 0.6))


def ball_on_ball(s):
    s.ball(at(-0.75, 0, -0.05), 0.62, A)
    s.ball(at(0.75, 0, 0.05), 0.5)
    bounce(s, at(-0.2, -0.2, 0), X, 0.5)


def ball_on_cylinder(s):
    s.cylinder(at(-0.2, 1.5, -0.5), at(-0.2, -1.5, -0.5), 0.5, A)
    s.ball(at(0.05, -0.2, 0.62), 0.42)
    bounce(s, at(-0.02, -0.6, -0.0), unit(at(0.05, 0, 1)), 0.32)


def ellipsoid_on_plane(s):
    s.plane(at(0, 0, -0.5), 1.8 * X, 1.1 * Y)
    x, y = s.place(at(0, 0, -0.02))
    s.lines.append('<ellipse cx="%.4g" cy="%.4g" rx="40" ry="17" transform="rotate(-12 %.4g %.4g)" fill="%s" stroke="%s" '
                   'stroke-width="1.3"/>' % (x, y, x, y, B[0], B[1]))
    s.path([(x - 22, y - 4), (x - 8, y - 10), (x + 6, y - 12)], "white", width=1.6)
    s.dot(at(-0.15, -0.1, -0.5), RED, 3)
    s.turn(at(0, 0, 0.75), Z, 0.4, 150, 420)


def contacts(s):
    s.plane(at(0, 0.2, -0.75), 1.9 * X, 1.0 * Y)
    for x, y, z in ((-0.75, 0.6, -0.45), (-0.1, 0.6, -0.45), (0.55, 0.6, -0.45), (-0.45, 0.3, 0.05), (0.2, 0.3, 0.05), (-0.1, 0.1, 0.55)):
        s.ball(at(x, y, z), 0.32)
    s.cylinder(at(1.2, 0.9, -0.35), at(1.2, -0.6, -0.35), 0.38, A)
    s.tube(lambda t: at(1.2 + 0.5 * math.cos(t), -0.2, -0.35 + 0.5 * math.sin(t)), 0.1, 2.9, 0.06, B)


def plate(s, shift=O):
    s.face([at(-1.2, -0.9) + shift, at(1.2, -0.9) + shift, at(1.2, 0.9) + shift, at(-1.2, 0.9) + shift], B)
    for x in (-0.6, 0, 0.6):
        s.line(at(x, -0.9) + shift, at(x, 0.9) + shift, colour=B[1], width=0.5)
    for y in (-0.3, 0.3):
        s.line(at(-1.2, y) + shift, at(1.2, y) + shift, colour=B[1], width=0.5)


def support(s):
    plate(s)
    for y in (-0.9, -0.3, 0.3, 0.9):
        p = at(-1.2, y)
        s.face([p, p + at(-0.14, 0, -0.26), p + at(0.14, 0, -0.26)], ("white", A[1]))
    s.line(at(-1.2, -0.9), at(-1.2, 0.9), colour=RED, width=2.4)
    p = at(1.2, -0.9)
    s.face([p, p + at(-0.14, 0, -0.26), p + at(0.14, 0, -0.26)], ("white", A[1]))
    s.dot(p, RED, 3)


def distributing(s):
    plate(s, at(-0.6, 0, 0))
    end = at(1.6, 0, 0)
    for y in (-0.9, -0.45, 0, 0.45, 0.9):
        s.line(at(0.6, y), end, colour=RED, width=1)
    s.line(at(0.6, -0.9), at(0.6, 0.9), colour=RED, width=2.4)
    s.box(end, (0.45, 0.45, 0.4), A)


def chart(s, function, colour=RED):
    row = [(30 + 130 * x, 105 - 80 * function(x)) for x in np.linspace(0, 1, 60)]
    s.path(row, colour, width=1.8)


def word(s, x, y, words, size=11, colour="#333"):
    s.lines.append('<text x="%g" y="%g" font-size="%g" fill="%s">%s</text>' % (x, y, size, colour, words))


def thread(s):
    # the nut as a block on its thread, unrolled
    slope, normal, foot = unit(at(3.2, 0, 1.2)), unit(at(-1.2, 0, 3.2)), at(0.15, 0, -0.19)
    s.face([at(-1.8, 0, -0.92), at(1.4, 0, -0.92), at(1.4, 0, 0.28)], A)
    s.face([foot + a * slope + b * normal for a, b in ((-0.55, 0), (0.55, 0), (0.55, 0.6), (-0.55, 0.6))], B)
    s.arrow(foot + 0.3 * normal, foot + 0.3 * normal - 1.2 * Z, False, B[1])
    s.arrow(foot, foot + 0.95 * normal, False)
    s.arrow(foot, foot + 1.2 * slope, False)
    s.text(at(0.12, 0, 1.0), "N", RED, 12)
    s.text(at(1.35, 0, 0.42), "μN", RED, 12)
    s.text(at(0.2, 0, -1.35), "W", B[1], 12)
    s.text(at(-1.15, 0, -0.87), "λ", size=12)


def bearing_length(s):
    s.box(at(0, 0, -0.35), (3.6, 0.3, 0.26), A)
    s.box(at(0, -0.05, -0.35), (1.4, 0.4, 0.5), B)
    s.box(at(0, -0.05, 0.4), (0.26, 0.4, 1.0), B)
    s.arrow(at(0.13, -0.25, 0.75), at(1.2, -0.25, 0.75), False, B[1])
    s.text(at(1.3, -0.25, 0.7), "P", B[1], 12)
    s.arrow(at(-0.62, -0.25, 0.5), at(-0.62, -0.25, -0.1), False)
    s.arrow(at(0.62, -0.25, -1.2), at(0.62, -0.25, -0.6), False)
    s.text(at(-1.72, -0.25, 0.3), "P a/L", RED, 12)
    s.text(at(0.75, -0.25, -1.15), "P a/L", RED, 12)


def friction(s):
    s.axes(30, 105)
    chart(s, lambda x: (0.5 + 0.4 * math.exp(-(x / 0.28) ** 2)) * math.tanh(x / 0.025))
    s.path([(30, 65), (160, 65)], "#999", width=0.8, dashed=True)
    s.path([(30, 33), (160, 33)], "#999", width=0.8, dashed=True)
    word(s, 8, 37, "μₛN")
    word(s, 8, 69, "μN")
    word(s, 112, 121, "slip speed")
    word(s, 118, 28, "Stribeck", 12, RED)


def bristles(s):
    s.box(at(0, 0, 0.55), (2.4, 0.8, 0.5), B)
    s.box(at(0, 0, -0.75), (3.4, 0.8, 0.3), A)
    for x in np.linspace(-1.05, 1.05, 8):
        s.curve(lambda t: at(x - 0.22 + 0.34 * t * t, -0.4, -0.55 + 0.85 * t), 0, 1, 10, colour=RED, width=1.5)
    s.arrow(at(1.35, -0.4, 0.5), at(2.05, -0.4, 0.5), False)
    s.line(at(-1.05 - 0.22, -0.4, -1.1), at(-1.05 + 0.12, -0.4, -1.1), width=1)
    s.text(at(-1.2, -0.4, -1.4), "z")


def rolling_friction(s):
    s.plane(at(0, 0, -0.55), 1.8 * X, 1.1 * Y)
    s.ball(O, 0.55)
    s.arrow(at(0.65, 0, 0.0), at(1.5, 0, 0.0), False, B[1])
    s.turn(O, -Y, 0.78, 200, 330, False)
    s.text(at(-1.75, 0, 0.55), "μᵣ N R", RED, 12)


def turning_friction(s):
    s.plane(at(0, 0, -0.55), 1.8 * X, 1.1 * Y)
    s.ball(O, 0.55)
    s.turn(at(0, 0, 0.62), Z, 0.4, 150, 420, False, B[1])
    s.turn(at(0, 0, -0.55), -Z, 0.7, 150, 350, False)
    s.text(at(0.85, 0, -0.25), "μₜ N R", RED, 12)


KINDS = [revolute, prismatic, screw, cylindrical, planar, spherical, universal, skew_universal, constant_velocity, in_line, in_plane,
         point_on_curve, rigid, flexible_joint, distance, spring, springs_in_fixed_axes, gear, backlash, stops, sliding_point,
         sliding_sleeve, sliding_prismatic, sliding_screw, buffer, rolling_ball, rolling_disc, knife_edge, ball_on_plane, ball_on_ball,
         ball_on_cylinder, ellipsoid_on_plane, contacts, friction, bristles, thread, bearing_length,
         rolling_friction, turning_friction, support, distributing]


def make(parts, drawn):
    for kind in KINDS:
        if not parts or kind.__name__ in parts:
            sketch = Sketch()
            kind(sketch)
            sketch.write(kind.__name__)
