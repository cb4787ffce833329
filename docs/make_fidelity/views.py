"""Which picture stands beside which reference: one row for each, cameras chosen by hand to look alike."""

from dataclasses import dataclass
from typing import Optional, Tuple


@dataclass(frozen=True)
class View:
    """A model as a reference picture shows it."""
    name: str                             # of the row, unique
    model: str                            # file below ASSETS/gltf
    reference: str                        # file below ASSETS/reference
    options: Tuple[str, ...] = ()         # of `candil render`: camera, light
    background: Optional[str] = "corner"  # "#rrggbb", the colour of the reference's upper left corner, or None: as rendered
    spp: int = 32


@dataclass(frozen=True)
class Beside:
    """A model that Blender Cycles renders too, with the same camera and environment."""
    model: str
    azimuth: float = 30   # degrees, as --orbit
    elevation: float = 20
    zoom: float = 1       # 1: the sphere around the model fills the height of the frame


def _orbit(azimuth, elevation, *more):
    return ("--orbit", f"{azimuth},{elevation}") + more


def _khronos(model, suffix, options, background="corner", spp=32, file=None):
    return View(model, f"{model}/{file or model + '.gltf'}", f"khronos-screenshots/{model}.{suffix}", options, background,
                spp)


def _glb(model, suffix, options, **more):
    return _khronos(model, suffix, options, file=f"{model}.glb", **more)


def _certified(model, camera, file):
    return View(f"{model} {camera}", f"{model}/{file}", f"3DC/rr-{model}-{camera}.png", ("--camera", str(camera)),
                "#ffffff")


# The tests' eye is at (-2.83, 2.83, -2.83) in a left-handed world: here that is +Z. Some models were scaled first.
def _swift(model, distance, *more):
    return View(f"{model} (SwiftGLTF)", f"{model}/{model}.glb", f"SwiftGLTF/{model}.png",
                ("--orbit", f"-45,35.26,{distance}", "--fov", "60") + more, "#000000")


_ROOM = ("--env", "{env}/blender_interior.exr")

VIEWS = (
    _glb("AlphaBlendModeTest", "jpg", _orbit(0, 8)),
    _glb("AnisotropyRotationTest", "png", _orbit(0, 0)),
    _glb("AnisotropyStrengthTest", "png", _orbit(-12, -8)),
    _glb("AttenuationTest", "jpg", _orbit(-8, -6)),
    _glb("BoxInterleaved", "png", _orbit(-30, 20)),
    _glb("BoxTexturedNonPowerOfTwo", "png", _orbit(45, 25)),
    _glb("BoxVertexColors", "png", _orbit(38, 32)),
    _khronos("BoxWithSpaces", "png", _orbit(42, 30), file="Box With Spaces.gltf"),
    _khronos("Cameras", "png", ("--camera", "0")),
    _khronos("ClearCoatTest", "jpg", _orbit(25, -15)),
    _glb("ClearcoatWicker", "jpg", _orbit(0, 5)),
    _glb("EmissiveStrengthTest", "jpg", _orbit(12, 15) + _ROOM),
    _khronos("FlightHelmet", "jpg", _orbit(35, 10)),
    _glb("GlassBrokenWindow", "jpg", _orbit(0, 5) + ("--env", "{env}/dresden_square_1k.hdr"), background=None),
    _glb("GlassHurricaneCandleHolder", "jpg", _orbit(0, 5) + _ROOM, background=None),
    _glb("IridescenceSuzanne", "jpg", _orbit(0, 0) + _ROOM, spp=64),
    _khronos("LightsPunctualLamp", "png", _orbit(25, 5) + _ROOM),
    _khronos("MeshPrimitiveModes", "png", _orbit(0, 0) + ("--point-radius", "0.01")),
    _glb("MetalRoughSpheresNoTextures", "png", _orbit(0, 0)),
    _khronos("MultiUVTest", "jpg", _orbit(125, 25)),
    _khronos("MultipleScenes", "png", _orbit(0, 0)),
    _glb("NegativeScaleTest", "jpg", _orbit(0, 0)),
    _glb("NormalTangentTest", "png", _orbit(0, 0)),
    _glb("OrientationTest", "png", _orbit(40, 30)),
    _glb("RecursiveSkeletons", "jpg", _orbit(305, 30) + ("--at", "0.35")),
    _khronos("SheenChair", "jpg", _orbit(0, 5)),
    _khronos("SimpleMeshes", "png", _orbit(0, 0)),
    _khronos("SimpleMorph", "png", _orbit(0, 0) + ("--at", "1.28")),
    _khronos("SimpleSparseAccessor", "png", _orbit(0, 0)),
    _khronos("Suzanne", "jpg", _orbit(30, 15), file="02_suzanne.gltf"),
    _glb("TextureCoordinateTest", "png", _orbit(0, 0)),
    _glb("TextureEncodingTest", "png", _orbit(0, 0)),
    _khronos("TextureSettingsTest", "png", _orbit(0, 0)),
    _glb("TextureTransformMultiTest", "jpg", _orbit(0, -20)),
    _khronos("TextureTransformTest", "jpg", _orbit(0, 0)),
    _glb("TransmissionTest", "jpg", ("--look-from", "-0.12,0.15,1.45", "--look-at", "-0.12,-0.08,0", "--fov", "35")),
    _khronos("Triangle", "png", _orbit(0, 0)),
    _khronos("TriangleWithoutIndices", "png", _orbit(0, 0)),
    _khronos("TwoSidedPlane", "jpg", _orbit(22, 32)),
    _khronos("UnlitTest", "jpg", _orbit(0, 15) + ("--tonemap", "none")),
    _khronos("WaterBottle", "jpg", _orbit(35, 10)),
    _certified("Mixer", 0, "Mixer.gltf"),
    _certified("Mixer", 1, "Mixer.gltf"),
    _certified("Mixer", 2, "Mixer.gltf"),
    _certified("WickerChair", 0, "WickerChair.glb"),
    _certified("WickerChair", 1, "WickerChair.glb"),
    _certified("WickerChair", 2, "WickerChair.glb"),
    _swift("CompareBaseColor", 2.4),
    _swift("CompareEmissiveStrength", 2.4, *_ROOM),
    _swift("CompareMetallic", 2.4),
    _swift("OrientationTest", 27),
    _swift("TextureCoordinateTest", 5.6),
)

BESIDE = (
    Beside("AlphaBlendModeTest/AlphaBlendModeTest.glb", 10, 8, 1.6),
    Beside("AnisotropyRotationTest/AnisotropyRotationTest.glb", 0, 0, 1.2),
    Beside("AnisotropyStrengthTest/AnisotropyStrengthTest.glb", 0, 0, 1.4),
    Beside("AttenuationTest/AttenuationTest.glb", -8, -6, 1.2),
    Beside("BoxTexturedNonPowerOfTwo/BoxTexturedNonPowerOfTwo.glb", 45, 25),
    Beside("BoxVertexColors/BoxVertexColors.glb", 38, 32),
    Beside("ClearCoatTest/ClearCoatTest.gltf", 0, 0, 1.2),
    Beside("ClearcoatWicker/ClearcoatWicker.glb", 0, 10),
    Beside("CompareBaseColor/CompareBaseColor.glb", 0, 10, 1.5),
    Beside("CompareEmissiveStrength/CompareEmissiveStrength.glb", 0, 10, 1.5),
    Beside("CompareMetallic/CompareMetallic.glb", 0, 10, 1.5),
    Beside("DispersionTest/dispersion-test.glb", 0, 10, 1.5),
    Beside("EmissiveStrengthTest/EmissiveStrengthTest.glb", 12, 15, 1.4),
    Beside("FlightHelmet/FlightHelmet.gltf", 30, 10),
    Beside("GlassBrokenWindow/GlassBrokenWindow.glb", 10, 5),
    Beside("GlassHurricaneCandleHolder/GlassHurricaneCandleHolder.glb", 0, 5),
    Beside("IorBlender/17_ior.gltf", 20, 20),
    Beside("IridescenceSuzanne/IridescenceSuzanne.glb", 0, 0, 1.6),
    Beside("LightsPunctualLamp/LightsPunctualLamp.gltf", -155, 5),
    Beside("MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb", 0, 0, 1.3),
    Beside("Mixer/Mixer.gltf", 30, 10),
    Beside("MultiUVTest/MultiUVTest.gltf", 125, 25),
    Beside("NegativeScaleTest/NegativeScaleTest.glb", 0, 0, 1.2),
    Beside("NormalTangentTest/NormalTangentTest.glb", 0, 0, 1.2),
    Beside("OrientationTest/OrientationTest.glb", 40, 30),
    Beside("SheenBlender/19_sheen.gltf", 0, 10, 1.2),
    Beside("SheenChair/SheenChair.gltf", 20, 10),
    Beside("SpecularBlender/20_specular.gltf", 0, 10, 1.2),
    Beside("Suzanne/02_suzanne.gltf", 30, 10),
    Beside("TextureEncodingTest/TextureEncodingTest.glb", 0, 0, 1.2),
    Beside("TextureSettingsTest/TextureSettingsTest.gltf", 0, 0, 1.2),
    Beside("TextureTransformMultiTest/TextureTransformMultiTest.glb", 0, 0, 1.2),
    Beside("TextureTransformTest/TextureTransformTest.gltf", 0, 0, 1.2),
    Beside("TransmissionBlender/15_transmission.gltf", 0, 10, 1.2),
    Beside("TransmissionTest/TransmissionTest.glb", 0, 5, 1.3),
    Beside("TwoSidedPlane/TwoSidedPlane.gltf", 30, 30, 1.2),
    Beside("UnlitTest/UnlitTest.gltf", 0, 15),
    Beside("WaterBottle/WaterBottle.gltf", 30, 10),
    Beside("WickerChair/WickerChair.glb", 30, 10),
)
