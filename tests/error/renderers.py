"""The renderers of the benchmark under one interface: render(spp, seed) gives a picture and the seconds of the rendering alone, whole(spp,
seed) the seconds of a process from its start to its picture. `why` says why a renderer cannot show a scene, else it is None; `note` says
what is unlike ours in it; `step` is what its pictures can tell apart, 0 for floats."""
import json, os, shutil, subprocess, tempfile, time
import numpy as np
import ours, povray_side

HERE = os.path.dirname(os.path.abspath(__file__))


class Ours:
    name = "ours"
    why, note, step = None, "", 0.0

    def __init__(self, binary, scene, folder, threads, flags=()):
        self.path, self.out = ours.write(scene, folder), os.path.join(folder, "ours.pfm")
        self.command = [binary, self.path, self.out, "--quiet", "--stats=json", "--threads", str(threads), *flags]

    def run(self, spp, seed):
        start = time.perf_counter()
        done = subprocess.run(self.command + ["--spp", str(spp), "--seed", str(seed)], check=True, stdout=subprocess.PIPE, text=True)
        return json.loads(done.stdout), time.perf_counter() - start

    def render(self, spp, seed):
        stats, _ = self.run(spp, seed)
        return ours.pfm(self.out), stats["seconds"]["render"]

    def whole(self, spp, seed):
        return self.run(spp, seed)[1]

    def close(self): pass


class PovRay:
    name = "povray"
    step = povray_side.STEP

    def __init__(self, binary, scene, folder, threads):
        self.binary, self.scene, self.folder, self.threads = binary, scene, folder, threads
        try:
            povray_side.write(scene, folder, 1, 0)
            self.why = None if shutil.which(binary) else "there is no " + binary
        except povray_side.Cannot as why: self.why = str(why)
        floors = ["area light: its shadow and its light are averaged apart"] * any(l.kind == "rectangle" for l in scene.lamps)
        floors += ["lens: one set of points for all pixels"] * bool(scene.aperture)
        self.note = "; ".join(floors)

    def render(self, spp, seed):
        return povray_side.render(self.binary, self.scene, self.folder, spp, seed, self.threads)[:2]

    def whole(self, spp, seed):
        return povray_side.render(self.binary, self.scene, self.folder, spp, seed, self.threads)[2]

    def close(self): pass


class Server:
    """A peer in a process of serve.py."""
    step = 0.0

    def __init__(self, name, python, scene, folder, threads, sampler="multijitter"):
        self.name, self.out, self.log = name, os.path.join(folder, name + ".npy"), os.path.join(folder, name + ".log")
        self.command = [python, "-B", os.path.join(HERE, "serve.py"), name, scene.name, str(scene.size), folder, str(threads), sampler]
        self.process = self.start()
        answer = self.process.stdout.readline().strip()
        self.why = None if answer.startswith("ready") else answer[len("cannot "):] or "it failed; see " + self.log
        self.note = "spheres are meshes" if name == "cycles" and any(s.kind == "sphere" for s in scene.shapes) else ""

    def start(self, home=None):
        with open(self.log, "a") as log:
            return subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log, text=True,
                                    env={**os.environ, **({"HOME": home} if home else {})})

    def note_compiling(self):
        """Compiled kernels are kept in the home folder, so that whole() finds them there; in another one they are not."""
        self.whole(1, 1)
        usual = self.whole(1, 1)
        with tempfile.TemporaryDirectory() as home: more = self.whole(1, 1, home) - usual
        self.note = "kernels are in its cache; without them a process takes %.1f s more" % more

    def request(self, process, spp, seed):
        process.stdin.write("%d %d %s\n" % (spp, seed, self.out))
        process.stdin.flush()
        answer = process.stdout.readline()
        if not answer: raise SystemExit("error: %s failed; see %s" % (self.name, self.log))
        return float(answer)

    def render(self, spp, seed):
        seconds = self.request(self.process, spp, seed)
        return np.load(self.out).astype(np.float64), seconds

    def whole(self, spp, seed, home=None):
        """Without the translation of the scene, which a user has in a file."""
        start, process = time.perf_counter(), self.start(home)
        translation = float(process.stdout.readline().split()[1])
        self.request(process, spp, seed)
        process.stdin.close()
        process.wait()
        return time.perf_counter() - start - translation

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def peers(options, scene, folder, sampler="multijitter"):
    """All of them, also those that cannot show the scene."""
    return [Server("mitsuba_llvm", options.mitsuba, scene, folder, options.threads, sampler),
            Server("mitsuba_scalar", options.mitsuba, scene, folder, options.threads, sampler),
            Server("cycles", options.bpy, scene, folder, options.threads), PovRay(options.povray, scene, folder, options.threads)]
