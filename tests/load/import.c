/* SPDX-License-Identifier: MIT */
#include "load/import.h"
#include "base/log.h"
#include "folder.h"
#include "model_file.h"
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A glTF file around one right triangle in the plane z = 0, with corners 0, x and y. */
#define GLTF(rest)                                                                               \
	"{\"asset\":{\"version\":\"2.0\"},\"scene\":0,"                                          \
	"\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"        \
	"AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"                                  \
	"\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"                                    \
	"\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"," \
	"\"min\":[0,0,0],\"max\":[1,1,0]}]," rest "}"

static void nodes_are_flattened(void **state)
{
	(void)state;
	const char *path = folder_write_text(
		"nodes.gltf", GLTF("\"scenes\":[{\"nodes\":[0]}],"
				   "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}},"
				   "{\"mode\":0,\"attributes\":{\"POSITION\":0}}]}],"
				   "\"nodes\":[{\"translation\":[10,0,0],\"children\":[1,2]},"
				   "{\"name\":\"wing\",\"mesh\":0,\"scale\":[2,3,4],"
				   "\"rotation\":[0,0,0.70710678,0.70710678]},"
				   "{\"mesh\":0,\"translation\":[0,0,5]}]"));
	/* Stretched, then a quarter turn about z, then moved; the points are left out. */
	static const float wing[16] = {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 0, 0, 1};
	struct model *model = load_model(path, PLAN_UP_AUTO);
	assert_int_equal(model->mesh_count, 1);
	assert_int_equal(model->meshes[0].index_count, 3);
	assert_int_equal(model->object_count, 2);
	assert_string_equal(model->objects[0].name, "wing");
	check_floats(model->objects[0].transform, wing, 16);
	assert_float_equal(model->objects[1].transform[12], 10, 1e-5);
	assert_float_equal(model->objects[1].transform[14], 5, 1e-5);
	assert_int_equal(model->objects[0].image, SM_NONE);
	assert_false(model->has_camera);
	model_destroy(model);
}

static void points_and_lines_are_left_out(void **state)
{
	(void)state;
	const char *path = folder_write_text(
		"mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\np 3\nl 1 2 3\n");
	struct model *model = load_model(path, PLAN_UP_AUTO);
	size_t indices = 0;
	for (size_t i = 0; i < model->mesh_count; i++)
		indices += model->meshes[i].index_count;
	assert_int_equal(indices, 3);
	model_destroy(model);
}

static void missing_normals_are_made(void **state)
{
	(void)state;
	const char *path = folder_write_text("normals.gltf",
		GLTF("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
		     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"));
	struct model *model = load_model(path, PLAN_UP_AUTO);
	assert_non_null(model->meshes[0].normals);
	check_floats(model->meshes[0].normals, (const float[3]){0, 0, 1}, 3);
	model_destroy(model);
}

/* glTF's base colour is linear and stays; OBJ's diffuse colour is as on a screen. */
static void base_colors_become_linear(void **state)
{
	(void)state;
	const char *path = folder_write_text(
		"color.gltf", GLTF("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
				   "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":"
				   "[0.25,0.5,0.75,1]}}],\"meshes\":[{\"primitives\":"
				   "[{\"material\":0,\"attributes\":{\"POSITION\":0}}]}]"));
	struct model *model = load_model(path, PLAN_UP_AUTO);
	check_floats(model->objects[0].base_color, (const float[3]){.25f, .5f, .75f}, 3);
	model_destroy(model);

	folder_write_text("color.mtl", "newmtl m\nKd 0.5 0 1\n");
	path = folder_write_text(
		"color.obj", "mtllib color.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
	model = load_model(path, PLAN_UP_AUTO);
	check_floats(model->objects[0].base_color, (const float[3]){.2140411f, 0, 1}, 3);
	model_destroy(model);
}

/* glTF's materials show their fronts alone unless they say otherwise; others do not say. */
static void a_gltf_material_is_single_sided_unless_it_is_double_sided(void **state)
{
	(void)state;
	static const struct {
		const char *material;
		bool single_sided;
	} cases[] = {
		{"{}", true}, {"{\"doubleSided\":false}", true}, {"{\"doubleSided\":true}", false}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		char text[1024];
		snprintf(text, sizeof(text),
			GLTF("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
			     "\"materials\":[%s],\"meshes\":[{\"primitives\":"
			     "[{\"material\":0,\"attributes\":{\"POSITION\":0}}]}]"),
			cases[i].material);
		struct model *model =
			load_model(folder_write_text("sides.gltf", text), PLAN_UP_AUTO);
		assert_int_equal(model->objects[0].single_sided, cases[i].single_sided);
		model_destroy(model);
	}
	struct model *model =
		load_model(folder_write_text("sides.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
			PLAN_UP_AUTO);
	assert_false(model->objects[0].single_sided);
	model_destroy(model);
}

static void the_camera_is_taken(void **state)
{
	(void)state;
	const char *path = folder_write_text("camera.gltf",
		GLTF("\"scenes\":[{\"nodes\":[0,1,2]}],"
		     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
		     "\"cameras\":[{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,"
		     "\"ymag\":1,\"znear\":0.1,\"zfar\":9}},"
		     "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.6,\"znear\":0.1,"
		     "\"aspectRatio\":1.5}}],"
		     "\"nodes\":[{\"mesh\":0},{\"camera\":0},{\"name\":\"eye\",\"camera\":1,"
		     "\"translation\":[1,2,5],\"rotation\":[0,0.70710678,0,0.70710678]}]"));
	struct model *model = load_model(path, PLAN_UP_AUTO);
	assert_true(model->has_camera);
	check_floats(model->camera.eye, (const float[3]){1, 2, 5}, 3);
	check_floats(model->camera.target, (const float[3]){0, 2, 5}, 3);
	check_floats(model->camera.up, (const float[3]){0, 1, 0}, 3);
	assert_float_equal(model->camera.fov, 34.377468, 1e-4); /* .6 radians */
	assert_int_equal(model->width, 1440);
	assert_int_equal(model->height, 960);
	model_destroy(model);
}

static void lights_are_taken(void **state)
{
	(void)state;
	const char *path = folder_write_text("lights.gltf",
		GLTF("\"extensionsUsed\":[\"KHR_lights_punctual\"],"
		     "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\","
		     "\"color\":[1,0.5,0.25],\"intensity\":80,\"spot\":{\"innerConeAngle\":0.3,"
		     "\"outerConeAngle\":0.5}},{\"type\":\"point\",\"intensity\":20},"
		     "{\"type\":\"directional\",\"intensity\":3}]}},"
		     "\"scenes\":[{\"nodes\":[0,1,2,3]}],"
		     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
		     "\"nodes\":[{\"mesh\":0},{\"name\":\"lamp\",\"translation\":[0,4,0],"
		     "\"rotation\":[-0.70710678,0,0,0.70710678],"
		     "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
		     "{\"name\":\"bulb\",\"translation\":[1,2,3],"
		     "\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},"
		     "{\"name\":\"sun\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}}]"));
	struct model *model = load_model(path, PLAN_UP_AUTO);
	assert_int_equal(model->light_count, 3);
	const struct model_light *lamp = &model->lights[0], *bulb = &model->lights[1],
				 *sun = &model->lights[2];
	assert_string_equal(lamp->desc.name, "lamp");
	check_floats(lamp->desc.position, (const float[3]){0, 4, 0}, 3);
	check_floats(lamp->desc.target, (const float[3]){0, 3, 0}, 3);
	check_floats(lamp->desc.color, (const float[3]){1, .5f, .25f}, 3);
	assert_float_equal(lamp->desc.angle, 57.29578, 1e-3); /* twice .5 radians */
	assert_float_equal(lamp->desc.softness, .4, 1e-5);
	assert_float_equal(lamp->desc.intensity, 80, 1e-4);
	check_floats(lamp->fade, (const float[3]){0, 0, 1}, 3);
	assert_false(bulb->aimed);
	check_floats(bulb->desc.position, (const float[3]){1, 2, 3}, 3);
	assert_int_equal(sun->desc.type, SM_LIGHT_DIRECTIONAL);
	assert_true(isnan(sun->desc.radius));
	model_destroy(model);
}

/* Four texels: red, green, blue, white. */
static const uint8_t texels[2][2][4] = {
	{{255, 0, 0, 255}, {0, 255, 0, 255}}, {{0, 0, 255, 255}, {255, 255, 255, 255}}};

static void write_png(const char *name)
{
	png_image image = {
		.version = PNG_IMAGE_VERSION, .width = 2, .height = 2, .format = PNG_FORMAT_RGBA};
	assert_true(png_image_write_to_file(&image, folder_path(name), 0, texels, 0, NULL));
}

/* An OBJ file whose only triangle has the texture and spans all of it. */
static const char *write_textured(const char *name, const char *texture)
{
	char material[200];
	snprintf(material, sizeof(material), "newmtl m\nKd 1 1 1\nmap_Kd %s\n", texture);
	folder_write_text("textured.mtl", material);
	return folder_write_text(name, "mtllib textured.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
				       "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
}

static void a_png_texture_is_decoded(void **state)
{
	static const char *const names[] = {"colors.png", "lost\\\\way\\\\colors.png"};
	(void)state;
	write_png("colors.png");
	for (int i = 0; i < 2; i++) {
		struct model *model = load_model(write_textured("png.obj", names[i]), PLAN_UP_AUTO);
		assert_int_equal(model->image_count, 1);
		assert_int_equal(model->images[0].width, 2);
		assert_memory_equal(model->images[0].rgba, texels, sizeof(texels));
		assert_int_equal(model->objects[0].image, 0);
		/* OBJ counts v from the bottom, the scene from the first row. */
		check_floats(model->meshes[0].uvs, (const float[6]){0, 1, 1, 1, 0, 0}, 6);
		model_destroy(model);
	}
}

static void take_line(void *data, enum sm_log_level level, const char *line)
{
	assert_int_equal(level, SM_LOG_WARNING);
	snprintf(data, 500, "%s", line);
}

static void a_texture_that_fails_is_left_out_with_a_warning(void **state)
{
	static const struct {
		const char *bytes, *problem;
	} cases[] = {
		{NULL, "not found"},
		{"GIF89a......", "neither PNG nor JPEG"},
		{"\x89PNG\r\n\x1a\n....", "a damaged PNG"},
		{"\xff\xd8\xff\xff\xff", SMOOTHIE_JPEG_PROBLEM},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		char line[500] = "", expected[700];
		if (cases[i].bytes != NULL)
			folder_write_text("broken.png", cases[i].bytes);
		const char *path = write_textured("broken.obj", "broken.png");
		snprintf(expected, sizeof(expected), "%s: texture broken.png is left out: %s", path,
			cases[i].problem);
		log_set_sink(take_line, line);
		struct model *model = load_model(path, PLAN_UP_AUTO);
		log_set_sink(NULL, NULL);
		assert_string_equal(line, expected);
		assert_int_equal(model->image_count, 0);
		assert_int_equal(model->objects[0].image, SM_NONE);
		model_destroy(model);
	}
}

static void an_embedded_texture_is_decoded(void **state)
{
	(void)state;
	const char *path = "/usr/share/assimp/models/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb";
	FILE *file = fopen(path, "rb");
	if (file == NULL)
		skip();
	fclose(file);
	struct model *model = load_model(path, PLAN_UP_AUTO);
	assert_int_equal(model->image_count, 1);
	assert_true(model->images[0].width > 1);
	assert_int_equal(model->objects[0].image, 0);
	assert_null(model->notes);
	model_destroy(model);
}

/* Where the file's z axis comes to point. */
static void check_up(const char *path, enum plan_up up, bool is_z_up)
{
	struct model *model = load_model(path, up);
	const float *z = model->objects[0].transform + 8;
	check_floats(z, is_z_up ? (const float[3]){0, 1, 0} : (const float[3]){0, 0, 1}, 3);
	model_destroy(model);
}

static void the_up_axis_follows_the_format(void **state)
{
	(void)state;
	const char *obj = folder_write_text("up.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
	check_up(obj, PLAN_UP_AUTO, false);
	check_up(obj, PLAN_UP_Z, true);
	const char *stl = folder_write_text("up.stl",
		"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
		"vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
	check_up(stl, PLAN_UP_AUTO, true);
	check_up(stl, PLAN_UP_Y, false);
}

/* A 3DS file of one triangle in the plane z = 0, with corners 0, x and y. */
static const char *write_3ds(bool with_mesh_version)
{
	static const uint8_t version[] = {0x3e, 0x3d, 10, 0, 0, 0, 3, 0, 0, 0};
	static const uint8_t object[] = {
		0x00, 0x40, 74, 0, 0, 0, 't', 0,                       /* named object */
		0x00, 0x41, 66, 0, 0, 0,                               /* mesh */
		0x10, 0x41, 44, 0, 0, 0, 3, 0,                         /* corners */
		0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,                    /* 0 0 0 */
		0, 0, 0x80, 0x3f, 0, 0, 0, 0, 0, 0, 0, 0,              /* 1 0 0 */
		0, 0, 0, 0, 0, 0, 0x80, 0x3f, 0, 0, 0, 0,              /* 0 1 0 */
		0x20, 0x41, 16, 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 7, 0, /* face */
	};
	uint8_t file[22 + sizeof(version) + sizeof(object)] = {
		0x4d, 0x4d, 0, 0, 0, 0, 2, 0, 10, 0, 0, 0, 3, 0, 0, 0, 0x3d, 0x3d};
	size_t size = 22;
	if (with_mesh_version) {
		memcpy(file + size, version, sizeof(version));
		size += sizeof(version);
	}
	memcpy(file + size, object, sizeof(object));
	size += sizeof(object);
	file[2] = (uint8_t)size;
	file[18] = (uint8_t)(size - 16);
	return folder_write(with_mesh_version ? "studio.3ds" : "converter.3ds", file, size);
}

/* Height of the model in world space: its triangle stands if y is up in the file. */
static float height_of(const char *path, enum plan_up up)
{
	struct model *model = load_model(path, up);
	struct model_placement placement = {.transform = {[0] = 1, [5] = 1, [10] = 1, [15] = 1}};
	float box[2][3] = {{9, 9, 9}, {-9, -9, -9}};
	model_grow_box(model, NULL, &placement, false, box);
	model_destroy(model);
	return box[1][1] - box[0][1];
}

static void a_3ds_file_is_z_up_as_3d_studio_writes_it(void **state)
{
	(void)state;
	const char *studio = write_3ds(true), *converter = write_3ds(false);
	assert_float_equal(height_of(studio, PLAN_UP_AUTO), 0, 1e-5);
	assert_float_equal(height_of(converter, PLAN_UP_AUTO), 1, 1e-5);
	assert_float_equal(height_of(converter, PLAN_UP_Z), 0, 1e-5);
	assert_float_equal(height_of(studio, PLAN_UP_Y), 1, 1e-5);
}

static void check_failure(const char *path, const char *cause)
{
	struct sm_error error;
	char expected[700];
	struct model *model = model_create(NULL);
	assert_non_null(model);
	snprintf(expected, sizeof(expected), "%s: %s", path, cause);
	assert_false(import_model(path, PLAN_UP_AUTO, model, &error));
	assert_string_equal(error.text, expected);
	assert_int_equal(error.status, SM_ERROR_INPUT);
	model_destroy(model);
}

static void useless_files_are_refused(void **state)
{
	(void)state;
	check_failure(folder_path("missing.obj"), "No such file or directory");
	check_failure("/tmp", "not a regular file");
	check_failure(folder_write_text("a.txt", "hello, world\n"),
		"not a model in a format that is known");
	check_failure(folder_write_text("points.gltf",
			      GLTF("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
				   "\"meshes\":[{\"primitives\":[{\"mode\":0,\"attributes\":"
				   "{\"POSITION\":0}}]}]")),
		"without triangles");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nodes_are_flattened),
		cmocka_unit_test(points_and_lines_are_left_out),
		cmocka_unit_test(missing_normals_are_made),
		cmocka_unit_test(base_colors_become_linear),
		cmocka_unit_test(a_gltf_material_is_single_sided_unless_it_is_double_sided),
		cmocka_unit_test(the_camera_is_taken),
		cmocka_unit_test(lights_are_taken),
		cmocka_unit_test(a_png_texture_is_decoded),
		cmocka_unit_test(a_texture_that_fails_is_left_out_with_a_warning),
		cmocka_unit_test(an_embedded_texture_is_decoded),
		cmocka_unit_test(the_up_axis_follows_the_format),
		cmocka_unit_test(a_3ds_file_is_z_up_as_3d_studio_writes_it),
		cmocka_unit_test(useless_files_are_refused),
	};
	return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
