/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* ppoll() */
#include "app/driver_options.h"
#include "app/facts.h"
#include "app/program_store.h"
#include "app/report.h"
#include "app/scene_options.h"
#include "app/screen.h"
#include "app/service.h"
#include "app/stopwatch.h"
#include "base/array.h"
#include "base/log.h"
#include "load/motion.h"
#include "platform.h"
#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/signalfd.h>
#include <time.h>
#include <unistd.h>

enum {
	FLAG_CONNECTOR = FLAG_OWN_OF_SCENES,
	FLAG_MODE,
	FLAG_ROTATE,
	FLAG_FORMAT,
	FLAG_VSYNC,
	FLAG_LEGACY,
	FLAG_LIST,
	FLAG_FRAMES,
	FLAG_STATS,
};

static const struct flag flags[] = {
	{FLAG_LIST, "list", NULL, "list devices, monitors, modes and formats instead"},
	{FLAG_DEVICE, "device", "PATH",
		"such as /dev/dri/card0; default: the first with a monitor"},
	{FLAG_CONNECTOR, "connector", "NAME", "where the monitor is, such as HDMI-A-1"},
	{FLAG_MODE, "mode", "preferred|current|WxH[@HZ]", "of the monitor; default: preferred"},
	{FLAG_ROTATE, "rotate", "0|90|180|270", "turn the picture clockwise, in degrees"},
	{FLAG_FORMAT, "format", "NAME", "of the pixels: xrgb8888, rgb565 or xrgb2101010"},
	{FLAG_VSYNC, "vsync", "on|off", "off: show frames at once, where the driver can"},
	{FLAG_LEGACY, "legacy", NULL, "do without atomic mode-setting"},
	SCENE_FLAGS,
	{FLAG_FRAMES, "frames", "N", "end after N frames; default: run until a signal"},
	{FLAG_STATS, "stats", NULL, "print counts and times at the end, and on SIGUSR1"},
	DRIVER_FLAGS,
	SKIP_FLAG,
	COMMON_FLAGS,
};

struct show_options {
	struct common_options common;
	struct scene_options scene;
	struct driver_options driver;
	struct display_options display;
	uint32_t frames; /* 0: until a signal */
	bool list, stats;
};

/* All that a run holds, in the order it is made. */
struct show {
	const struct show_options *options;
	struct stage stage;
	int signals; /* descriptor; -1: none */
	struct display *display;
	struct program_store programs;
	struct sm_renderer *renderer; /* NULL until the display has a context */
	struct screen screen;
	bool ended;
	bool was_on;
	double start;       /* of the program, ms of the monotonic clock */
	double first_frame; /* ms from the start; 0: none yet */
	double last_alive;  /* ms of the monotonic clock */
};

static bool choose(const char *value, const char *const *words, size_t count, size_t *index)
{
	for (*index = 0; *index < count; (*index)++)
		if (strcmp(words[*index], value) == 0)
			return true;
	return false;
}

static bool read_flag(
	struct show_options *options, int id, const char *value, struct sm_error *error)
{
	static const char *const angles[] = {"0", "90", "180", "270"};
	static const char *const switches[] = {"on", "off"};
	size_t index;
	switch (id) {
	case FLAG_LIST:
		options->list = true;
		return true;
	case FLAG_CONNECTOR:
		options->display.connector = value;
		return true;
	case FLAG_MODE:
		options->display.mode = value;
		return true;
	case FLAG_ROTATE:
		if (!choose(value, angles, 4, &index))
			return options_error(error, &show_command,
				"--rotate %.40s: 0, 90, 180 or 270 is wanted", value);
		options->display.rotation = 90 * (unsigned)index;
		return true;
	case FLAG_FORMAT:
		options->display.format = value;
		return true;
	case FLAG_VSYNC:
		if (!choose(value, switches, 2, &index))
			return options_error(
				error, &show_command, "--vsync %.40s: on or off is wanted", value);
		options->display.async = index == 1;
		return true;
	case FLAG_LEGACY:
		options->display.legacy = true;
		return true;
	case FLAG_FRAMES:
		return options_number(value, 1, INT32_MAX, &options->frames) ||
		       options_error(error, &show_command,
			       "--frames %.40s: a number from 1 is wanted", value);
	case FLAG_STATS:
		options->stats = true;
		return true;
	default:
		if (scene_options_has(id))
			return scene_options_flag(&options->scene, &show_command, id, value, error);
		if (driver_options_has(id))
			return driver_options_flag(&options->driver, id, value, error);
		options_common(&options->common, id, value);
		return true;
	}
}

static bool read_options(
	struct show_options *options, int argc, char **argv, struct sm_error *error)
{
	*options = (struct show_options){.common = options_defaults()};
	if (!scene_options_init(&options->scene, argc, error))
		return false;
	int id;
	while ((id = options_next(&show_command, argc, argv, error)) >= 0)
		if (!read_flag(options, id, optarg, error))
			return false;
	if (id == FLAG_FAILED)
		return false;
	options->display.device = options->common.device;
	options->display.debug = options->common.debug;
	return options->common.help || options->list ||
	       scene_options_argument(&options->scene, &show_command, argc, argv, error);
}

/* From here on signals arrive when there is time for them, so that they cannot interrupt what has
 * to be undone. */
static bool catch_signals(struct show *show, struct sm_error *error)
{
	sigset_t set;
	sigemptyset(&set);
	sigaddset(&set, SIGINT);
	sigaddset(&set, SIGTERM);
	sigaddset(&set, SIGHUP);
	sigaddset(&set, SIGUSR1);
	pthread_sigmask(SIG_BLOCK, &set, NULL);
	/* Counts into a closed pipe are an error like others; a stopped program would keep the
	 * display. */
	signal(SIGPIPE, SIG_IGN);
	signal(SIGTSTP, SIG_IGN);
	show->signals = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
	return show->signals >= 0 ||
	       error_set(error, SM_ERROR_MACHINE, "cannot wait for signals (%s)", strerror(errno));
}

static void print_renderer(const struct show *show, struct facts *facts)
{
	struct sm_frame_stats stats = {0};
	if (show->renderer != NULL) {
		sm_renderer_get_stats(show->renderer, &stats);
		driver_options_describe_skips(show->renderer, facts);
	}
	facts_format(facts, "programs compiled", "%" PRIu32, stats.programs_compiled);
	facts_format(facts, "programs loaded", "%" PRIu32, stats.programs_loaded);
}

static void print_stats(const struct show *show)
{
	struct facts facts;
	struct display_stats stats;
	display_get_stats(show->display, &stats);
	/* Without a flip there was no overhead either. */
	double flips = stats.flips > 0 ? (double)stats.flips : 1;
	facts_begin(&facts, stdout, false);
	display_describe(show->display, facts_sink, &facts);
	facts_format(&facts, "first frame", "%.1f ms", show->first_frame);
	facts_format(&facts, "frames drawn", "%" PRIu64, stats.frames);
	facts_format(&facts, "flips", "%" PRIu64, stats.flips);
	facts_format(&facts, "missed vblanks", "%" PRIu64, stats.missed);
	facts_format(&facts, "outside GL", "%.3f ms a frame", stats.overhead / flips);
	facts_format(&facts, "processor time", "%.1f ms", stopwatch_processor_time());
	print_renderer(show, &facts);
	facts_end(&facts);
}

/* On a signal the picture goes on even where the counts cannot be written. */
static void print_stats_now(const struct show *show)
{
	print_stats(show);
	if (fflush(stdout) != 0) {
		log_warning("cannot write the counts to standard output (%s)", strerror(errno));
		clearerr(stdout);
	}
}

static void read_signals(struct show *show)
{
	struct signalfd_siginfo info;
	while (read(show->signals, &info, sizeof(info)) == sizeof(info)) {
		if (info.ssi_signo == SIGUSR1)
			print_stats_now(show);
		else
			show->ended = true;
	}
}

static bool make_renderer(struct show *show, struct sm_error *error)
{
	if (show->renderer != NULL)
		return true;
	show->renderer = driver_options_renderer(&show->options->driver, error);
	if (show->renderer == NULL)
		return false;
	program_store_init(&show->programs);
	sm_renderer_set_program_store(show->renderer, &show->programs.calls);
	return sm_renderer_set_shadows(show->renderer, &show->stage.shadow, error);
}

static bool set_time(struct show *show, struct sm_error *error)
{
	uint32_t numerator, denominator;
	display_get_refresh(show->display, &numerator, &denominator);
	/* The frames of motion_time() count from 1. */
	double seconds = motion_time(display_tick(show->display) + 1, numerator, denominator);
	return stage_set_time(&show->stage, seconds, error);
}

/* Whether the screen shows the stage as it is. */
static bool is_shown(const struct show *show)
{
	return show->renderer != NULL && show->options->frames == 0 &&
	       !display_wants_frame(show->display, false) &&
	       screen_is_current(&show->screen, show->renderer, &show->stage);
}

static bool draw_frame(struct show *show, struct sm_error *error)
{
	struct display_target wanted;
	if (!set_time(show, error))
		return false;
	if (is_shown(show)) {
		display_keep(show->display);
		return true;
	}
	/* Another size sets the stage back. */
	return display_begin(show->display, &wanted, error) && make_renderer(show, error) &&
	       screen_fit(&show->screen, &wanted, &show->stage, error) && set_time(show, error) &&
	       screen_draw(&show->screen, show->renderer, &show->stage, error) &&
	       display_end(show->display, show->screen.pixels, error);
}

/* Sleeps until the display, a signal or the watchdog has something to do. */
static bool wait_for_work(struct show *show, struct sm_error *error)
{
	struct pollfd fds[DISPLAY_POLL_MAX + 1] = {{.fd = show->signals, .events = POLLIN}};
	int64_t timeout;
	size_t count = 1 + display_poll(show->display, fds + 1, &timeout);
	if (service_watchdog() > 0) {
		double left = show->last_alive + service_watchdog() - stopwatch_now();
		int64_t watchdog = left > 0 ? (int64_t)(left * 1e6) : 0;
		timeout = timeout < 0 || timeout > watchdog ? watchdog : timeout;
	}
	struct timespec time = {timeout / 1000000000, timeout % 1000000000};
	if (ppoll(fds, count, timeout >= 0 ? &time : NULL, NULL) < 0 && errno != EINTR)
		return error_set(error, SM_ERROR_MACHINE, "cannot wait for the display (%s)",
			strerror(errno));
	read_signals(show);
	return true;
}

static void tell_manager(struct show *show)
{
	bool is_on = display_is_on(show->display);
	double now = stopwatch_now();
	uint32_t watchdog = service_watchdog();
	if (is_on != show->was_on)
		service_status(is_on ? "showing %s" : "waiting for the display, to show %s",
			show->options->scene.scene);
	show->was_on = is_on;
	if (watchdog > 0 && now - show->last_alive >= watchdog) {
		service_alive();
		show->last_alive = now;
	}
}

/* Notes the time of the first frame, and ends after the last. */
static void count_frames(struct show *show)
{
	struct display_stats stats;
	display_get_stats(show->display, &stats);
	if (show->first_frame == 0 && stats.flips > 0)
		show->first_frame = stopwatch_now() - show->start;
	if (show->options->frames > 0 && stats.flips >= show->options->frames)
		show->ended = true;
}

static bool run_display(struct show *show, struct sm_error *error)
{
	bool changes = stage_moves(&show->stage) || show->options->frames > 0;
	service_ready();
	show->was_on = !display_is_on(show->display); /* so that either is told of */
	while (!show->ended) {
		if (!display_update(show->display, error))
			return false;
		count_frames(show);
		tell_manager(show);
		if (show->ended)
			break;
		bool done = display_wants_frame(show->display, changes)
				    ? draw_frame(show, error)
				    : wait_for_work(show, error);
		if (!done)
			return false;
		read_signals(show);
	}
	return true;
}

static void finish(struct show *show)
{
	if (show->renderer != NULL) {
		screen_finish(&show->screen);
		sm_renderer_destroy(show->renderer);
		program_store_finish(&show->programs);
	}
	display_destroy(show->display);
	if (show->signals >= 0)
		close(show->signals);
	stage_finish(&show->stage);
}

static bool show_scene(const struct show_options *options, struct sm_error *error)
{
	/* Before main() runs the dynamic linker, which computes. */
	struct show show = {.options = options,
		.signals = -1,
		.start = stopwatch_now() - stopwatch_processor_time()};
	bool shown = scene_options_load(&options->scene, &show.stage, error) &&
		     catch_signals(&show, error);
	if (shown) {
		show.display = display_create(&options->display, error);
		shown = show.display != NULL && run_display(&show, error);
		service_stopping();
	}
	if (show.display != NULL && options->stats)
		print_stats(&show);
	finish(&show);
	return shown;
}

static bool run(int argc, char **argv, struct sm_error *error)
{
	struct show_options options;
	bool done = read_options(&options, argc, argv, error);
	if (done && options.common.help) {
		options_help(&show_command);
	} else if (done) {
		report_set_verbosity(options.common.debug ? 2 : options.common.verbosity);
		done = options.list ? display_list(options.common.device, stdout, error)
				    : show_scene(&options, error);
	}
	driver_options_finish(&options.driver);
	scene_options_finish(&options.scene);
	return done;
}

const struct command show_command = {
	.name = "show",
	.arguments = "SCENE [flags] | --list",
	.summary = "Show a scene on a monitor, without a windowing system.",
	.flags = flags,
	.flag_count = sizeof(flags) / sizeof(flags[0]),
	.run = run,
};
