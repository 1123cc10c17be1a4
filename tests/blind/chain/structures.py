"""Four plans: a girder of two spans, a truss, a frame of five storeys, a cable-stayed deck. What is drawn are sizes; groups are what an engineer would name."""
from plane import Member, Plan

STEEL, CONCRETE = (2.1e11, 7850.0), (3.4e10, 2500.0)


def girder(random):
    """Two spans on elastic bearings; six zones of two members a span."""
    first, second = random.uniform(24.0, 32.0), random.uniform(28.0, 38.0)
    area, inertia = 0.9, random.uniform(0.25, 0.35)
    nodes, members = {}, []
    for i in range(25):
        nodes[i + 1] = (first * i / 12.0 if i <= 12 else first + second * (i - 12) / 12.0, 0.0)
    for i in range(24):
        members.append(Member((i + 1, i + 2), f"zone_{i // 2 + 1:02d}", area, inertia, *CONCRETE, shear_area=0.35))
    springs = [(f"bearing_{name}", node, "z", 9e8) for name, node in (("west", 1), ("pier", 13), ("east", 25))]
    return Plan("girder", nodes, members, {1: "x"}, springs, [], [(n, "z") for n in (3, 4, 6, 7, 9, 10, 11, 15, 16, 18, 19, 21, 22, 24)], first + second)


def truss(random):
    """A Warren truss with posts, ten panels; chords by thirds, diagonals by halves."""
    panel, height = random.uniform(3.6, 4.4), random.uniform(4.0, 4.8)
    nodes = {i + 1: (panel * i, 0.0) for i in range(11)} | {i + 12: (panel * (i + 1), height) for i in range(9)}
    third = ("west", "middle", "east")
    members = [Member((i + 1, i + 2), f"bottom_{third[min(i // 3, 2)]}", 0.018, 0.0, *STEEL) for i in range(10)]
    members += [Member((i + 12, i + 13), f"top_{third[min(i // 3, 2)]}", 0.020, 0.0, *STEEL) for i in range(8)]
    diagonals = [(1, 12), (20, 11)] + [(i + 2, i + 13) if i >= 4 else (i + 12, i + 3) for i in range(8)]
    members += [Member(ends, "diagonals_west" if min(nodes[e][0] for e in ends) < 5 * panel else "diagonals_east", 0.010, 0.0, *STEEL) for ends in diagonals]
    members += [Member((i + 2, i + 12), "posts", 0.007, 0.0, *STEEL) for i in range(9)]
    masses = [("floor", i + 1, random.uniform(0.98, 1.02) * 5000.0) for i in range(11)]
    springs = [("bearing_west", 1, "z", 1.5e9), ("bearing_east", 11, "z", 1.5e9)]
    return Plan("truss", nodes, members, {1: "x"}, springs, masses, [(n, "z") for n in range(2, 11)] + [(n, "x") for n in (11, 14, 16, 18)], 10.0 * panel)


def frame(random):
    """Five storeys, two bays; columns and beams by storey, feet that turn."""
    bay, storey = random.uniform(5.0, 6.5), random.uniform(3.0, 3.8)
    nodes = {3 * level + i + 1: (bay * i, storey * level) for level in range(6) for i in range(3)}
    members = []
    for level in range(5):
        members += [Member((3 * level + i + 1, 3 * level + i + 4), f"columns_{level + 1}", 0.16, 2.1e-3, *CONCRETE, shear_area=0.13) for i in range(3)]
        members += [Member((3 * level + i + 4, 3 * level + i + 5), f"beams_{level + 1}", 0.18, 5.4e-3, *CONCRETE, shear_area=0.15) for i in range(2)]
    masses = [(f"slab_{level}", 3 * level + i + 1, 9000.0 * (1.0 if i != 1 else 2.0)) for level in range(1, 6) for i in range(3)]
    springs = [(f"foot_{i + 1}", i + 1, "r", 4e8) for i in range(3)]
    sensors = [(3 * level + 1, "x") for level in range(1, 6)] + [(3 * level + 2, "x") for level in (2, 4)] + [(3 * level + i + 1, "z") for level in (2, 5) for i in (0, 1)]
    return Plan("frame", nodes, members, {i + 1: "xz" for i in range(3)}, springs, masses, sensors, 5.0 * storey)


def cable_stayed(random):
    """A deck on two bearings and a tower with eight stays; the tower stands beside the deck."""
    panel, above = random.uniform(5.5, 7.0), random.uniform(20.0, 26.0)
    nodes = {i + 1: (panel * i, 0.0) for i in range(17)}
    members = [Member((i + 1, i + 2), f"deck_{i // 2 + 1}", 0.12, 0.022, *STEEL, shear_area=0.05) for i in range(16)]
    tower = [(8 * panel, z) for z in (-10.0, 0.5, 0.55 * above, 0.7 * above, 0.85 * above, above)]
    nodes |= {18 + i: at for i, at in enumerate(tower)}
    members += [Member((18 + i, 19 + i), "tower_low" if i < 2 else "tower_top", 0.35, 0.09, *STEEL) for i in range(5)]
    stays = {"W1": (7, 20), "W2": (5, 21), "W3": (3, 22), "W4": (1, 23), "E1": (11, 20), "E2": (13, 21), "E3": (15, 22), "E4": (17, 23)}
    members += [Member(ends, f"stay_{name}", 0.004 if name[1] != "4" else 0.006, 0.0, 1.95e11, 7850.0, pull=1.2e6) for name, ends in stays.items()]
    masses = [("paving", i + 1, 2500.0 * panel) for i in range(17)]
    springs = [("bearing_west", 1, "z", 4e8), ("bearing_east", 17, "z", 4e8), ("bearing_tower", 9, "z", 2e8)]
    sensors = [(n, "z") for n in (2, 3, 4, 5, 6, 7, 11, 12, 13, 14, 15, 16)] + [(21, "x"), (23, "x")]
    return Plan("cable-stayed", nodes, members, {9: "x", 18: "xzr"}, springs, masses, sensors, 16.0 * panel)


STRUCTURES = (girder, truss, frame, cable_stayed)
