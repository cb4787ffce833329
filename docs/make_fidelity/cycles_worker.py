"""Renders one model by Cycles. Runs in a Python that has bpy: PYTHON cycles_worker.py JOB, JOB as beside.py writes it."""

import json
import math
import sys

import bpy
from mathutils import Vector

LUMENS_PER_WATT = 683  # by which the importer divides in its mode SPEC


def to_blender(point):
    """glTF has +Y up, Blender +Z."""
    return Vector((point[0], -point[2], point[1]))


def set_environment(path):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    image = nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(path)
    image.image.colorspace_settings.name = "Linear Rec.709"
    background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    links.new(image.outputs["Color"], background.inputs["Color"])
    links.new(background.outputs["Background"], output.inputs["Surface"])


def set_camera(job):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(job["fov"])
    data.clip_start, data.clip_end = 1e-4, 1e6
    camera = bpy.data.objects.new("camera", data)
    eye, center = to_blender(job["eye"]), to_blender(job["center"])
    camera.location = eye
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = (center - eye).to_track_quat("-Z", "Y")
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def main():
    job = json.loads(sys.argv[1])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=job["model"], export_import_convert_lighting_mode="SPEC")
    # Candela to W/sr and back: candil has one unit for a candela and for the environment's radiance.
    for light in bpy.data.lights:
        light.energy *= LUMENS_PER_WATT
    set_environment(job["environment"])
    set_camera(job)
    scene = bpy.context.scene
    scene.frame_set(0)
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = job["spp"]
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.sample_clamp_indirect = 0
    scene.cycles.blur_glossy = 0
    scene.cycles.max_bounces = 64
    for kind in ("diffuse", "glossy", "transmission", "transparent_max", "volume"):
        name = f"{kind}_bounces" if kind != "transparent_max" else "transparent_max_bounces"
        setattr(scene.cycles, name, 64)
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x = scene.render.resolution_y = job["size"]
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = job["output"]
    bpy.ops.render.render(write_still=True)


main()
