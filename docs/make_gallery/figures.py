"""The table of figures: one row for each figure of the report. To add one, add a row; a scene goes to scenes/report."""

from table import Figure, Panel, ReportTime

WIDE = (640, 480)
NORMALS = ("--integrator", "normals")
BUNNY = "Bunny: Stanford Computer Graphics Laboratory."


def pair(number, name, area_report=None, point_report=None, point="point light"):
    """The report's usual two pictures: the same scene in an area light and in a point light."""
    base = f"fig{number:02}"
    return (Panel(f"{base}a", "area light", f"{base}a_{name}_area.json", report=area_report),
            Panel(f"{base}b", point, f"{base}b_{name}_point.json", report=point_report))


def path_counts(number, scene):
    return tuple(Panel(f"fig{number:02}_{spp}", f"{spp} paths per pixel", scene, spp=spp, keeps_spp=True)
                 for spp in (16, 64, 256, 1024))


def operator(number, label, choice):
    return (Panel(f"fig{number:02}", label, "fig13_tone_mapping.json", WIDE, 512, operator=choice),)


FIGURES = (
    Figure(1, "Paths per pixel",
           "The report's default scene: infinite planes, a diffuse and a plastic sphere, an area light. Noise falls as "
           "the number of paths grows.",
           path_counts(1, "fig01_box.json")),
    Figure(2, "Time against paths per pixel",
           "The box of figure 1 with its area light. The dashed lines are the report's measurements (table 1) on its "
           "own machine, for pictures whose size it does not tell: slopes compare, heights do not. Both grow in "
           "proportion to the number of paths.",
           drawing="fig02_time.svg"),
    Figure(3, "Area light and point light",
           "In the report a point light costs nearly twice the time of an area light, because only point lights are "
           "sampled directly; `--integrator classic` repeats that. `path` samples every light directly, so both cost "
           "about the same.",
           drawing="fig03_time.svg"),
    Figure(4, "Point light", "The box of figure 1 in the light of a point.", path_counts(4, "fig04_box_point.json")),
    Figure(5, "Diffuse material", "Lambertian spheres.", pair(5, "diffuse")),
    Figure(6, "Perfect mirrors",
           "A point has no surface to be mirrored; under the area light the mirrors also throw light on the walls.",
           pair(6, "specular")),
    Figure(7, "Plastic", "A diffuse part and a mirror-like one.",
           pair(7, "plastic", ReportTime(551.948, 1024), ReportTime(996.912, 1024), "point light behind a sphere")),
    Figure(8, "Dielectrics",
           "Index of refraction 2.42 (diamond, left) and 1.5 (glass, right) in air, 1.000293. The caustics of the area "
           "light are found by paths that hit it by chance; those of a point cannot be.",
           pair(8, "dielectric", ReportTime(563.346, 1024), ReportTime(959.34, 1024))),
    Figure(9, "Finite and infinite area light", "The same radiance from a square and from the whole ceiling plane.",
           (Panel("fig09a", "square", "fig09a_finite_light.json", report=ReportTime(572.216, None)),
            Panel("fig09b", "infinite plane", "fig09b_infinite_light.json", report=ReportTime(365.698, None)))),
    Figure(10, "Two point lights", "The shadows tell where the lights are, and which one is stronger.",
           (Panel("fig10a", "equal power", "fig10a_equal_lights.json"),
            Panel("fig10b", "more power on the right", "fig10b_unequal_lights.json"))),
    Figure(11, "Shadows", "Soft from an area, hard from a point.",
           (Panel("fig11a", "area light", "fig11a_soft_shadow.json"),
            Panel("fig11b", "point light, shadow on the floor", "fig11b_hard_shadow.json"),
            Panel("fig11c", "point light, shadow on floor and wall", "fig11c_hard_shadow_corner.json"))),
    Figure(12, "Colour bleeding", "A diffuse and a plastic sphere colour the floor around them.",
           (Panel("fig12", "", "fig12_color_bleeding.json", WIDE),)),
    Figure(13, "Clamp", "Figures 13 to 17 and 22 are one render with high dynamic range, shown by `candil tonemap`. "
           "Clamping cuts what is above 1.", operator(13, "clamp", "clamp")),
    Figure(14, "Equalize", "Divided by the largest value of the picture: beside a bright lamp the rest is black.",
           operator(14, "equalize", "equalize")),
    Figure(15, "Equalize and clamp", "What reaches 0.78 of the largest value is white.",
           operator(15, "equalize-clamp, 0.78", "equalize-clamp")),
    Figure(16, "Gamma", "A gamma curve of 2.2 in place of the sRGB curve; 1 is white.",
           operator(16, "gamma, 2.2", "gamma")),
    Figure(17, "Clamp and gamma", "What reaches 0.86 of the largest value is white; then a gamma curve of 2.2.",
           operator(17, "clamp-gamma, 0.86", "clamp-gamma")),
    Figure(18, "Parallel work",
           "Which thread rendered which tile of 16 x 16 pixels of figure 1, and when, recorded in a real run. The "
           "report's producer puts regions into a queue; here each thread halves the part of the image it has until a "
           "tile is left, and a thread that runs out of work takes the largest part that another one has not begun.",
           drawing="fig18_tiles.svg"),
    Figure(20, "Three bunnies", f"208,363 primitives: three models of 69,451 triangles, and ten more. {BUNNY}",
           (Panel("fig20", "", "fig20_three_bunnies.json", WIDE, report=ReportTime(89 * 60, 1240)),)),
    Figure(21, "Phong's model", "kd = 0.65, ks = 0.2: the lobe narrows as the exponent grows.",
           tuple(Panel(f"fig21{letter}", f"exponent {exponent}", f"fig21{letter}_phong_{exponent}.json")
                 for letter, exponent in zip("abc", (2, 50, 250)))),
    Figure(22, "Reinhard's operators",
           "The report's overflowed; these work from 0 to 1e7 and on black pixels. `reinhard02` is the formula that it "
           "prints, `reinhard05` the operator that it names.",
           (Panel("fig22a", "reinhard02", "fig13_tone_mapping.json", WIDE, 512, operator="reinhard02"),
            Panel("fig22b", "reinhard05", "fig13_tone_mapping.json", WIDE, 512, operator="reinhard05"))),
    Figure(23, "Normals", f"`--integrator normals` at several triangle counts. {BUNNY}",
           tuple(Panel(f"fig23{letter}", f"{count:,} triangles", f"fig23{letter}_normals_{count}.json", options=NORMALS)
                 for letter, count in zip("abcd", (948, 3851, 16301, 69451)))),
    Figure(24, "Flat and smooth", "A teapot of 6,320 triangles: its faces' own normals, and normals interpolated from "
           "the vertices.",
           (Panel("fig24a", "flat", "fig24a_flat_teapot.json", WIDE, options=NORMALS),
            Panel("fig24b", "smooth", "fig24b_smooth_teapot.json", WIDE, options=NORMALS))),
    Figure(25, "Glass dragon", "47,794 triangles, index of refraction 1.52. Dragon: Stanford Computer Graphics "
           "Laboratory.",
           (Panel("fig25", "", "fig25_glass_dragon.json", WIDE, 1024, report=ReportTime(122 * 60, 1024)),)),
    Figure(26, "Parametrisation", "u runs to the right and v down from the upper left corner of an image.",
           (Panel("fig26", "red shows u, green shows v", "fig26_parametrisation.json"),)),
    Figure(27, "Coordinates of a plane",
           "The image repeats along u (red) and v (green), from the point of the plane; its normal is blue.",
           (Panel("fig27", "", "fig27_plane.json", WIDE),)),
    Figure(28, "Textures on planes", "A floor and a wall without end; the bricks have a bump map.",
           (Panel("fig28", "", "fig28_planes.json"),)),
    Figure(29, "Coordinates of a quad", "Three corners are given (yellow balls); u and v are projections on two sides.",
           (Panel("fig29", "", "fig29_quad.json", WIDE),)),
    Figure(30, "Textures on a sphere and quads", "A globe, a picture, boards and tiles.",
           (Panel("fig30", "", "fig30_textures.json"),)),
    Figure(31, "Depth of field", "The same scene with three apertures, in focus at the second sphere.",
           (Panel("fig31a", "pinhole", "fig31a_aperture.json", WIDE),
            Panel("fig31b", "lens of 3 cm radius", "fig31b_aperture.json", WIDE),
            Panel("fig31c", "lens of 10 cm radius", "fig31c_aperture.json", WIDE))),
)

# Which measurement a drawing shows; plots.py draws it.
DRAWINGS = {"fig02_time.svg": "timing", "fig03_time.svg": "timing", "fig18_tiles.svg": "schedule"}

# The report's table 1: paths per pixel, seconds with 8 threads, seconds with one.
REPORT_TABLE_1 = ((16, 7.7323, 19.2509), (64, 31.5305, 72.3457), (256, 127.15, 282.219), (1024, 506.235, 1104.08))
