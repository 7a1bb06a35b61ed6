"""A wall of rigid blocks on ground that moves, in physics engines for robots and games: how long one second of it takes.

    python shaken.py ../../structures/records/suite/chords-01.at2 [seconds]

The wall is that of 20 courses of five blocks of 0.8 x 1 x 0.175 m (110 with the halves), friction 0.65, 2400 kg/m3. As in voussoir the frame
is that of the ground: gravity gets minus its acceleration in every step. Engines run with the settings they come with (PyBullet: 1/240 s,
50 iterations; MuJoCo: 2 ms, elliptic cones as masonry slides by them). Times are those of one thread, processor time. What they say of the
wall is how far the blocks moved at most, over the thickness of 0.175 m; nobody says which of the numbers is right.
"""

import sys
from time import process_time

G = 9.80665
SIZE, COURSES, BLOCKS = (0.8, 1.0, 0.175), 20, 5
# PyBullet multiplies the coefficients of both bodies, MuJoCo takes the greater one.
MU = 0.65**0.5


def record(path):
    """Step (s) and samples (m/s2) of a PEER AT2 file."""
    lines = open(path).read().splitlines()
    step = float(lines[3].split("DT=")[1].split()[0])
    return step, [G * float(word) for line in lines[4:] for word in line.split()]


def boxes():
    """Centres and lengths along the wall."""
    for course in range(COURSES):
        z = (course + 0.5) * SIZE[2]
        lengths = [SIZE[0]] * BLOCKS
        if course % 2 == 0:
            lengths = [0.5 * SIZE[0]] + [SIZE[0]] * (BLOCKS - 1) + [0.5 * SIZE[0]]
        x = 0.0
        for length in lengths:
            yield (x + 0.5 * length, 0.0, z), length
            x += length


def at(ground, time):
    """The acceleration, linear between samples."""
    step, samples = ground
    k = int(time / step)
    if k + 1 >= len(samples):
        return 0.0
    part = time / step - k
    return (1 - part) * samples[k] + part * samples[k + 1]


def farthest(before, after):
    return max(sum((b - a) ** 2 for a, b in zip(p, q)) ** 0.5 for p, q in zip(before, after)) / SIZE[2]


def bullet(ground, seconds):
    import pybullet as p

    p.connect(p.DIRECT)
    floor = p.createCollisionShape(p.GEOM_BOX, halfExtents=(10, 10, 0.5))
    p.changeDynamics(p.createMultiBody(0, floor, basePosition=(0, 0, -0.5)), -1, lateralFriction=MU, restitution=0)
    stones = []
    for center, length in boxes():
        half = (0.5 * length, 0.5 * SIZE[1], 0.5 * SIZE[2])
        shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=half)
        stone = p.createMultiBody(2400 * length * SIZE[1] * SIZE[2], shape, basePosition=center)
        p.changeDynamics(stone, -1, lateralFriction=MU, restitution=0, linearDamping=0, angularDamping=0)
        p.changeDynamics(stone, -1, activationState=p.ACTIVATION_STATE_DISABLE_SLEEPING)
        stones.append(stone)
    dt = 1 / 240
    places = lambda: [p.getBasePositionAndOrientation(s)[0] for s in stones]
    p.setGravity(0, 0, -G)
    for _ in range(240):
        p.stepSimulation()
    before, start = places(), process_time()
    for k in range(round(seconds / dt)):
        p.setGravity(-at(ground, (k + 0.5) * dt), 0, -G)
        p.stepSimulation()
    return process_time() - start, farthest(before, places()), f"PyBullet {p.getAPIVersion()}"


def mujoco(ground, seconds):
    import mujoco as m

    stone = '<body pos="{} {} {}"><freejoint/><geom type="box" size="{} {} {}" density="2400"/></body>'
    bodies = "".join(stone.format(*c, 0.5 * length, 0.5 * SIZE[1], 0.5 * SIZE[2]) for c, length in boxes())
    model = m.MjModel.from_xml_string(
        '<mujoco><option cone="elliptic"/><size memory="1G"/><default><geom friction="0.65 0 0"/></default>'
        f'<worldbody><geom type="plane" size="10 10 1"/>{bodies}</worldbody></mujoco>'
    )
    data = m.MjData(model)
    dt = model.opt.timestep
    for _ in range(round(1 / dt)):
        m.mj_step(model, data)
    before, start = data.xpos[1:].copy().tolist(), process_time()
    for k in range(round(seconds / dt)):
        model.opt.gravity[:] = (-at(ground, (k + 0.5) * dt), 0, -G)
        m.mj_step(model, data)
    return process_time() - start, farthest(before, data.xpos[1:].tolist()), f"MuJoCo {m.__version__}"


if __name__ == "__main__":
    ground = record(sys.argv[1])
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
    print(f"{sum(1 for _ in boxes())} blocks, {seconds:g} s")
    for engine in (bullet, mujoco):
        took, far, name = engine(ground, seconds)
        print(f"{name}: {took:.1f} s, {took / seconds:.2f} s for each; moved by {far:.3f} of a thickness")
