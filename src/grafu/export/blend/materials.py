"""Materials in Blender: a Principled BSDF per material, images packed byte for byte."""

from typing import Any, final

import bpy

from grafu.export.blend.layout import COLOR_LAYER, UV_LAYER, fitted_name
from grafu.export.blend.mesh_arrays import BlendMaterial
from grafu.export.names import NameBook
from grafu.export.output_names import file_safe
from grafu.geometry.appearance import Material, Texture

_ENDING = {"image/png": ".png", "image/jpeg": ".jpg"}
_OCCLUSION_GROUP = "glTF Material Output"  # Blender has no occlusion; its glTF reader and writer keep it in this group


@final
class BlenderMaterials:
    """Makes every distinct material and every distinct image once; materials in `doubled` show from both sides."""

    def __init__(self, doubled: frozenset[BlendMaterial] = frozenset()) -> None:
        self._doubled = doubled
        self._materials: dict[BlendMaterial, Any] = {}
        self._images: dict[tuple[bytes, bool], Any] = {}
        self._files = NameBook()

    def material_of(self, shown: BlendMaterial) -> Any:
        """Returns Blender's material for a material."""
        if shown not in self._materials:
            self._materials[shown] = _MaterialNodes(shown, self).material
            if shown in self._doubled:
                self._materials[shown].use_backface_culling = False
        return self._materials[shown]

    def image_of(self, texture: Texture, is_color: bool) -> Any:
        """Returns Blender's image of a texture, packed; colours are sRGB, everything else is plain numbers."""
        key = (texture.data, is_color)
        if key not in self._images:
            self._images[key] = self._packed(texture, is_color)
        return self._images[key]

    def _packed(self, texture: Texture, is_color: bool) -> Any:
        image = bpy.data.images.new(fitted_name(texture.name or "image", 4), 1, 1, alpha=True)
        image.pack(data=texture.data, data_len=len(texture.data))
        image.source = "FILE"
        ending = _ENDING[texture.mime]
        stem = file_safe(texture.name).removesuffix(ending)
        image.filepath_raw = "//textures/" + self._files.unique(stem) + ending  # where unpacking puts it
        image.colorspace_settings.name = "sRGB" if is_color else "Non-Color"
        return image


@final
class _MaterialNodes:
    """Builds the nodes of one material as Blender's own glTF reader would, so that its writer understands them."""

    def __init__(self, shown: BlendMaterial, library: BlenderMaterials) -> None:
        self._shown = shown
        self._library = library
        source = shown.material
        self.material = bpy.data.materials.new(fitted_name(source.name or "material", 4))
        self.material.use_nodes = True
        self._tree = self.material.node_tree
        self._tree.nodes.clear()
        self._column = 0
        self._shader = self._node("ShaderNodeBsdfPrincipled", 0)
        output = self._node("ShaderNodeOutputMaterial", 300)
        self._join(self._shader.outputs["BSDF"], output.inputs["Surface"])
        self._color_image = self._image(source.base_color_texture, True)
        self._set_color(source)
        self._set_metal(source)
        self._set_normal(source)
        self._set_emission(source)
        self._set_occlusion(source)
        self._set_viewport(source)

    def _set_color(self, source: Material) -> None:
        red, green, blue, alpha = source.base_color
        color, opacity = self._input("Base Color"), self._input("Alpha")
        color.default_value = (red, green, blue, 1.0)
        sockets = self._color_factors()
        if sockets:
            tinted = [*sockets] if (red, green, blue) == (1.0, 1.0, 1.0) else [*sockets, (red, green, blue, 1.0)]
            self._join(self._product(tinted), color)
        if source.alpha_mode == "OPAQUE":
            return
        opacity.default_value = alpha
        see_through = self._alpha_socket(alpha)
        if source.alpha_mode == "MASK":
            below = self._math("LESS_THAN", see_through if see_through is not None else alpha, source.alpha_cutoff)
            self._join(self._math("SUBTRACT", 1.0, below), opacity)
        elif see_through is not None:
            self._join(see_through, opacity)

    def _color_factors(self) -> list[Any]:
        """Returns the sockets whose product with the base colour is the colour: the image's and the vertices'."""
        sockets = []
        if self._color_image is not None:
            sockets.append(self._color_image.outputs["Color"])
        if self._shown.colored:
            node = self._node("ShaderNodeVertexColor", -600)
            node.layer_name = COLOR_LAYER
            sockets.append(node.outputs["Color"])
        return sockets

    def _alpha_socket(self, alpha: float) -> Any:
        if self._color_image is None:
            return None
        socket = self._color_image.outputs["Alpha"]
        return socket if alpha == 1.0 else self._math("MULTIPLY", socket, alpha)

    def _set_metal(self, source: Material) -> None:
        self._input("Metallic").default_value = source.metallic
        self._input("Roughness").default_value = source.roughness
        node = self._image(source.metallic_roughness_texture, False)
        if node is None:
            return
        parts = self._node("ShaderNodeSeparateColor", -300)
        self._join(node.outputs["Color"], parts.inputs[0])
        for channel, name, factor in (("Green", "Roughness", source.roughness), ("Blue", "Metallic", source.metallic)):
            socket = parts.outputs[channel]
            self._join(socket if factor == 1.0 else self._math("MULTIPLY", socket, factor), self._input(name))

    def _set_normal(self, source: Material) -> None:
        node = self._image(source.normal_texture, False)
        if node is not None:
            bump = self._node("ShaderNodeNormalMap", -300)
            bump.uv_map = UV_LAYER
            self._join(node.outputs["Color"], bump.inputs["Color"])
            self._join(bump.outputs["Normal"], self._input("Normal"))

    def _set_emission(self, source: Material) -> None:
        glow = self._input("Emission Color", "Emission")
        glow.default_value = (*source.emissive, 1.0)
        self._input("Emission Strength").default_value = 1.0 if any(source.emissive) else 0.0
        node = self._image(source.emissive_texture, True) if any(source.emissive) else None
        if node is not None:
            socket = node.outputs["Color"]
            plain = source.emissive == (1.0, 1.0, 1.0)
            self._join(socket if plain else self._product([socket, (*source.emissive, 1.0)]), glow)

    def _set_occlusion(self, source: Material) -> None:
        node = self._image(source.occlusion_texture, False)
        if node is not None:
            parts = self._node("ShaderNodeSeparateColor", -300)
            self._join(node.outputs["Color"], parts.inputs[0])
            keeper = self._node("ShaderNodeGroup", 300)
            keeper.node_tree = _occlusion_group()
            self._join(parts.outputs["Red"], keeper.inputs["Occlusion"])

    def _set_viewport(self, source: Material) -> None:
        material = self.material
        material.use_backface_culling = not source.double_sided
        red, green, blue, alpha = source.base_color
        seen = alpha if source.alpha_mode != "OPAQUE" else 1.0
        material.diffuse_color = (red, green, blue, seen)
        material.metallic, material.roughness = source.metallic, source.roughness
        blended = source.alpha_mode == "BLEND"
        if hasattr(material, "surface_render_method"):
            material.surface_render_method = "BLENDED" if blended else "DITHERED"
        else:
            material.blend_method = {"OPAQUE": "OPAQUE", "MASK": "CLIP", "BLEND": "BLEND"}[source.alpha_mode]

    def _image(self, texture: Texture | None, is_color: bool) -> Any:
        if texture is None or not self._shown.textured:
            return None
        node = self._node("ShaderNodeTexImage", -900)
        node.image = self._library.image_of(texture, is_color)
        return node

    def _product(self, factors: list[Any]) -> Any:
        """Returns the socket of the product of colours; each is a socket or four numbers."""
        result = factors[0]
        for factor in factors[1:]:
            node = self._node("ShaderNodeMix", -300)
            node.data_type, node.blend_type = "RGBA", "MULTIPLY"
            node.inputs[0].default_value = 1.0
            colors = [socket for socket in node.inputs if socket.type == "RGBA"]
            self._give(result, colors[0])
            self._give(factor, colors[1])
            result = next(socket for socket in node.outputs if socket.type == "RGBA")
        return result

    def _math(self, operation: str, first: Any, second: Any) -> Any:
        node = self._node("ShaderNodeMath", -300)
        node.operation = operation
        self._give(first, node.inputs[0])
        self._give(second, node.inputs[1])
        return node.outputs[0]

    def _give(self, value: Any, socket: Any) -> None:
        if isinstance(value, bpy.types.NodeSocket):
            self._join(value, socket)
        else:
            socket.default_value = value

    def _input(self, *names: str) -> Any:
        """Returns the shader's input of the first name that this Blender knows."""
        return next(self._shader.inputs[name] for name in names if name in self._shader.inputs)

    def _join(self, output: Any, socket: Any) -> None:
        self._tree.links.new(output, socket)

    def _node(self, kind: str, x: float) -> Any:
        node = self._tree.nodes.new(kind)
        self._column += 1
        node.location = (x, -180.0 * self._column)
        return node


def _occlusion_group() -> Any:
    group = bpy.data.node_groups.get(_OCCLUSION_GROUP)
    if group is None:
        group = bpy.data.node_groups.new(_OCCLUSION_GROUP, "ShaderNodeTree")
        if hasattr(group, "interface"):
            group.interface.new_socket("Occlusion", socket_type="NodeSocketFloat")
        else:
            group.inputs.new("NodeSocketFloat", "Occlusion")
    return group
