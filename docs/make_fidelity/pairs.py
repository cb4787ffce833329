"""Our picture of a view, and the reference's, side by side."""

from PIL import Image

from program import Refused

LONGEST = 400  # pixels; smaller references are compared at their own size, but not below:
SHORTEST = 200


def _size(reference):
    longer = max(reference.size)
    factor = max(min(longer, LONGEST), SHORTEST) / longer
    return tuple(max(1, round(length * factor)) for length in reference.size)


def _flat(image, background):
    """Without alpha, over a colour."""
    if image.mode not in ("RGBA", "LA", "P"):
        return image.convert("RGB")
    image = image.convert("RGBA")
    return Image.alpha_composite(Image.new("RGBA", image.size, background), image).convert("RGB")


def _background(view, reference):
    if view.background != "corner":
        return view.background
    red, green, blue = _flat(reference, "#000000").getpixel((1, 1))
    return f"#{red:02x}{green:02x}{blue:02x}"


def side_by_side(path, *images):
    sheet = Image.new("RGB", (sum(image.width for image in images) + 4 * (len(images) - 1), images[0].height), "#ff00ff")
    left = 0
    for image in images:
        sheet.paste(image, (left, 0))
        left += image.width + 4
    sheet.save(path)


def make_pair(view, program, assets, folder, quality=1):
    """Renders, writes FOLDER/NAME.png (reference to the left) and returns the scores, or why there are none."""
    with Image.open(assets / "reference" / view.reference) as opened:
        reference = opened.copy()
    size = tuple(max(1, round(length * quality)) for length in _size(reference))
    stem = view.name.replace(" ", "_").replace("(", "").replace(")", "")
    theirs, ours = folder / f"{stem}-reference.png", folder / f"{stem}-candil.png"
    options = [option.format(env=assets / "env") for option in view.options]
    if view.background:
        options.append("--transparent")
    try:
        warnings = program.render(assets / "gltf" / view.model, [ours], size, max(1, round(view.spp * quality)), options)
    except Refused as error:
        return {"refused": str(error).replace(f"{assets}/", "")}
    background = _background(view, reference) or "#000000"
    _flat(reference, background).resize(size, Image.LANCZOS).save(theirs)
    with Image.open(ours) as opened:
        picture = _flat(opened, background)
    picture.save(ours)
    with Image.open(theirs) as left:
        side_by_side(folder / f"{stem}.png", left.convert("RGB"), picture)
    metrics = program.compare(theirs, ours)
    return {"flip": metrics["flip"], "ssim": metrics["ssim"],
            "warnings": [warning.replace(f"{assets}/", "") for warning in warnings]}
