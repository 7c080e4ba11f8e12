/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "base/log.h"
#include "display_state.h"
#include <stdlib.h>
#include <string.h>
#include <xf86drmMode.h>

const char *display_buffers(const struct display *display)
{
	static const char *const names[] = {
		[BUFFERS_GBM_MODIFIERS] = "GBM with modifiers",
		[BUFFERS_GBM] = "GBM",
		[BUFFERS_DUMB] = "dumb",
	};
	return names[display->attempts[display->attempt].buffers];
}

/* Whether buffers may be of that kind: $SMOOTHIE_BUFFERS, for debugging, allows gbm or dumb alone.
 */
static bool is_allowed(const char *kind)
{
	const char *only = getenv("SMOOTHIE_BUFFERS");
	return only == NULL || only[0] == '\0' || strcmp(only, kind) == 0;
}

static void add_attempt(struct display *display, int buffers, bool plane_turns)
{
	display->attempts[display->attempt_count++] = (struct attempt){buffers, plane_turns};
}

/* What the processor has drawn it may as well bring to the screen itself: it sees what has changed
 * in the frame, and copies and reports no more. Where the GPU draws that is the last resort. */
static void add_attempts(struct display *display, bool plane_turns)
{
	bool gbm = display->gbm != NULL && is_allowed("gbm");
	bool dumb = display->device.dumb && is_allowed("dumb");
	if (dumb && display->egl.software)
		add_attempt(display, BUFFERS_DUMB, plane_turns);
	if (gbm && display->output.modifier_count > 0)
		add_attempt(display, BUFFERS_GBM_MODIFIERS, plane_turns);
	if (gbm)
		add_attempt(display, BUFFERS_GBM, plane_turns);
	if (dumb && !display->egl.software)
		add_attempt(display, BUFFERS_DUMB, plane_turns);
}

/* What the plane turns costs the GPU nothing. */
static void list_attempts(struct display *display)
{
	bool can_turn = display->options.rotation != 0 && display->kms == &kms_atomic &&
			display->output.rotations & kms_rotation(display->options.rotation);
	display->attempt_count = display->attempt = 0;
	if (can_turn)
		add_attempts(display, true);
	add_attempts(display, false);
}

static void set_target(struct display *display, const struct attempt *attempt)
{
	const drmModeModeInfo *mode = &display->output.mode;
	bool upright = display->options.rotation % 180 == 0;
	display->target = (struct display_target){
		.width = upright ? mode->hdisplay : mode->vdisplay,
		.height = upright ? mode->vdisplay : mode->hdisplay,
		.rotation = attempt->plane_turns ? 0 : display->options.rotation,
		.takes_pixels = attempt->buffers == BUFFERS_DUMB,
	};
	for (int channel = 0; channel < 3; channel++)
		display->target.bits[channel] = display->output.format->bits[channel];
}

static struct swapchain *create_swapchain(
	struct display *display, const struct attempt *attempt, struct sm_error *error)
{
	const struct kms_output *output = &display->output;
	bool turned = display->target.rotation % 180 != 0;
	uint32_t width = turned ? display->target.height : display->target.width;
	uint32_t height = turned ? display->target.width : display->target.height;
	if (attempt->buffers == BUFFERS_DUMB)
		return swapchain_create_dumb(
			&display->device, output->format, width, height, error);
	return swapchain_create_gbm(&display->device, display->gbm, &display->egl, output->format,
		width, height, output->modifiers,
		attempt->buffers == BUFFERS_GBM_MODIFIERS ? output->modifier_count : 0, error);
}

/* What is on the screen, or on its way there, stays until the next frame replaces it. */
static void retire_swapchain(struct display *display)
{
	if (display->shown != 0 || display->pending != 0) {
		swapchain_destroy(display->retired);
		display->retired = display->swapchain;
	} else {
		swapchain_destroy(display->swapchain);
	}
	display->swapchain = NULL;
	display->shown = display->pending = 0;
}

/* Makes the swapchain of the current attempt, or of the first later one that works. */
static bool start_attempt(
	struct display *display, const struct sm_error *why, struct sm_error *error)
{
	struct sm_error last = *why;
	display->mode_set = false;
	display->stale = true;
	for (; display->attempt < display->attempt_count; display->attempt++) {
		const struct attempt *attempt = &display->attempts[display->attempt];
		retire_swapchain(display);
		set_target(display, attempt);
		display->swapchain = create_swapchain(display, attempt, &last);
		if (display->swapchain != NULL) {
			log_debug("%s: %ux%u %s, %s buffers%s", display->output.name,
				display->target.width, display->target.height,
				display->output.format->name, display_buffers(display),
				attempt->plane_turns ? ", turned by the plane" : "");
			return true;
		}
		log_debug("%s: no %s buffers (%s)", display->output.name, display_buffers(display),
			last.text);
	}
	return error_set(error, SM_ERROR_MACHINE, "%s cannot show %ux%u in %s: %.300s",
		display->output.name, display->output.mode.hdisplay, display->output.mode.vdisplay,
		display->output.format->name, last.text);
}

bool display_next_attempt(
	struct display *display, const struct sm_error *why, struct sm_error *error)
{
	log_debug("%s: %s", display->output.name, why->text);
	display->attempt++;
	return start_attempt(display, why, error);
}

static bool is_same(const struct kms_output *a, const struct kms_output *b)
{
	return a->connector == b->connector && a->crtc == b->crtc && a->plane == b->plane &&
	       a->format == b->format && mode_equal(&a->mode, &b->mode);
}

static bool use_output(
	struct display *display, const struct kms_output *output, struct sm_error *error)
{
	static const struct sm_error none = {.text = "no buffers"};
	if (display->saved.crtc != output->crtc) {
		kms_restore(&display->saved, &display->device);
		kms_save(&display->saved, &display->device, output);
	}
	display->output = *output;
	/* A later monitor may lack the mode that was wanted of the first. */
	display->wish.any_mode = true;
	if (mode_choose(&display->wish.mode, &output->mode, 1, &output->mode) == NULL)
		log_warning(
			"%s lacks the wanted mode: taking the one that it prefers", output->name);
	display_clock_set_refresh(&display->clock, mode_refresh(&output->mode));
	struct refresh refresh = display->clock.refresh;
	log_info("%s: %ux%u at %.5g Hz", output->name, output->mode.hdisplay, output->mode.vdisplay,
		(double)refresh.numerator / refresh.denominator);
	list_attempts(display);
	return start_attempt(display, &none, error);
}

/* Stays with the monitor that shows the picture, as long as it is there. */
static enum kms_search search(
	struct display *display, struct kms_output *output, bool probe, struct sm_error *error)
{
	struct kms_wish same = display->wish;
	if (same.connector == NULL && display->output.name[0] != '\0') {
		same.connector = display->output.name;
		struct sm_error gone; /* as connectors of docking stations may be */
		if (kms_output_find(output, &display->device, &same, probe, &gone) == KMS_FOUND)
			return KMS_FOUND;
	}
	return kms_output_find(output, &display->device, &display->wish, probe, error);
}

bool display_find_output(struct display *display, bool probe, struct sm_error *error)
{
	struct kms_output output;
	switch (search(display, &output, probe, error)) {
	case KMS_UNUSABLE:
		return false;
	case KMS_NO_MONITOR:
		if (display->output.name[0] != '\0') {
			log_info("%s: the monitor is gone", display->output.name);
			display_drop_output(display, true);
		}
		return true;
	case KMS_FOUND:
		break;
	}
	if (display->output.name[0] == '\0' || !is_same(&output, &display->output))
		return use_output(display, &output, error);
	/* Others may have lit planes and connectors meanwhile. */
	display->output = output;
	/* DisplayPort links that broke have to be set up anew. */
	if (output.connector_properties.link_status.value != 0) {
		display->mode_set = false;
		display->stale = true;
	}
	return true;
}

void display_drop_output(struct display *display, bool off)
{
	if (display->output.name[0] != '\0' && off) {
		display_await_flip(display);
		display->kms->switch_off(&display->device, &display->output);
	}
	swapchain_destroy(display->retired);
	swapchain_destroy(display->swapchain);
	display->retired = display->swapchain = NULL;
	display->shown = display->pending = 0;
	display->flip_pending = display->mode_set = false;
	display->output = (struct kms_output){0};
}
