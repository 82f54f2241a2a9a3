# cycles.py: a scene of the kit in Blender; kit.sh calls it with its name, samples, seed and the picture's file.
# The numbers are those of scenes/conform. x is negated, for Blender sees a right-handed world; corners are reversed.
import math, sys
import bpy
from mathutils import Matrix, Vector

name, spp, seed, path = sys.argv[sys.argv.index("--") + 1:]
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
flip = lambda p: Vector((-p[0], p[1], p[2]))

def material(kind, value):
    m = bpy.data.materials.new(kind)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    node = nodes.new("ShaderNode" + {"matte": "BsdfDiffuse", "mirror": "BsdfGlossy", "lamp": "Emission"}[kind])
    node.inputs["Color"].default_value = (1, 1, 1, 1) if kind == "lamp" else (value, value, value, 1)
    if kind == "mirror":
        node.distribution = "SHARP"
    if kind == "lamp":  # its front alone shines
        front, times = nodes.new("ShaderNodeNewGeometry"), nodes.new("ShaderNodeMath")
        times.operation = "MULTIPLY_ADD"
        times.inputs[1].default_value, times.inputs[2].default_value = -value, value
        links.new(front.outputs["Backfacing"], times.inputs[0])
        links.new(times.outputs[0], node.inputs["Strength"])
    links.new(node.outputs[0], out.inputs["Surface"])
    return m

def quad(look, *corners):
    mesh = bpy.data.meshes.new("quad")
    mesh.from_pydata([flip(p) for p in reversed(corners)], [], [(0, 1, 2, 3)])
    mesh.materials.append(look)
    bpy.context.collection.objects.link(bpy.data.objects.new("quad", mesh))

def ball(look, x, y, z, r):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=512, ring_count=256, radius=r, location=flip((x, y, z)))
    mesh = bpy.context.object.data
    mesh.materials.append(look)
    for face in mesh.polygons:
        face.use_smooth = True

quad(material("matte", .6), (-2, 0, -2), (-2, 0, 2), (2, 0, 2), (2, 0, -2))
quad(material("matte", .7), (-1, 0, .4), (-1, 1.2, .4), (-.5, 1.2, -.2), (-.5, 0, -.2))
if name == "mirror":
    quad(material("mirror", .8), (-2, 0, 1), (-2, 3, 1.6), (2, 3, 2), (2, 0, 1.4))
else:
    ball(material("matte", .4), .8, .5, .3, .5)
if name in ("area", "distant"):
    quad(material("matte", .6), (-2, 0, 2), (-2, 3, 2), (2, 3, 2), (2, 0, 2))
if name in ("area", "mirror"):
    quad(material("lamp", 6), (-1, 2.8, -.6), (.2, 2.8, -.6), (.2, 2.8, .4), (-1, 2.8, .4))
if name == "distant":
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = 2, 0
    thing = bpy.data.objects.new("sun", sun)
    thing.rotation_mode, thing.rotation_quaternion = "QUATERNION", flip((1, -2, 1.5)).to_track_quat("-Z", "Y")
    bpy.context.collection.objects.link(thing)
scene = bpy.context.scene
scene.world.use_nodes = True
sky = .7 if name == "sky" else 0
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (sky, sky, sky, 1)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.angle = math.radians(40)
back = (Vector((0, 1.6, -4.6)) - Vector((0, .9, 0))).normalized()
right = Vector((0, 1, 0)).cross(back).normalized()
up = back.cross(right)
camera.matrix_world = Matrix((right, up, back)).transposed().to_4x4()
camera.location = (0, 1.6, -4.6)
bpy.context.collection.objects.link(camera)
scene.camera = camera
scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.samples, cycles.seed, cycles.pixel_filter_type = int(spp), int(seed), "BOX"
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.light_sampling_threshold = 0
cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0
depth = 3 if name == "mirror" else 1
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = depth - 1
render = scene.render
render.resolution_x = render.resolution_y = 32
render.resolution_percentage, render.filter_size = 100, 1
settings = render.image_settings
settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
render.filepath = path
bpy.ops.render.render(write_still=True)
