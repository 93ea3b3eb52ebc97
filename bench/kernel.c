/* The nonlinear model with brush tyres, written by hand in C: what its compiled Python is measured against.

   Tables, states and inputs are those of yawdamp_ros/nonlinear/records.py and layout.py, and so are the
   equations; tyres by the magic formula are left out. */

#include <math.h>
#include <string.h>

#define GRAVITY 9.80665
#define AXLE_STEERING 8
#define MOST_UNITS 8
#define MOST_WHEELS 64
#define MOST_STATES (4 + 5 * MOST_UNITS + 2 * MOST_WHEELS)
#define MOST_ROWS (2 + 2 * MOST_UNITS)

typedef struct {
    double mass, yaw_inertia, roll_inertia, cg_height, roll_axis_height, front_hitch, rear_hitch, front_arm,
        rear_arm, cg_arm, front_height, rear_height, brake_limit, support_front, support_rear, hitch_load,
        hitch_roll_stiffness, hitch_roll_damping, hitch_friction, hitch_damping, max_articulation;
} Unit;

typedef struct {
    double position, half_track, steered, static_load, front_share, rear_share, relaxation_length,
        roll_stiffness, roll_damping, rolling_resistance, drive_share, brake_share, unit_brake_share,
        tyre_model, stiffness_rate, stiffness_slope, tyres;
} Axle;

typedef struct {
    double total_mass, drag, drag_height, nominal_friction, speed_gain, lowest_demand, highest_demand,
        load_shift_time, with_roll, with_load_shift, rollover_angle, swing_slip;
} Scalars;

typedef struct {
    long units, axles;
    const Unit *unit;
    const Axle *axle;
    const Scalars *scalars;
    const long *first_axle;
} Vehicle;

/* What one evaluation of the equations holds of each unit. */
typedef struct {
    double c, s, vx, vy, bias_x, bias_y, through_yaw_x, through_yaw_y, through_roll_x, through_roll_y,
        force_x, force_y, yaw_moment, roll_moment, carried, hitch_x, hitch_y, ax, ay, lean, upright;
} Body;

static double clamp(double value, double low, double high) { return fmin(fmax(value, low), high); }

static void chain(const Vehicle *v, const double *state, Body *body)
{
    const long n = v->units, rolls = 4 + 2 * n;
    double heading = 0.0, vx = state[2 + n], vy = state[3 + n], bias_x = 0.0, bias_y = 0.0;
    for (long k = 0; k < n; k++) {
        const Unit *u = &v->unit[k];
        Body *b = &body[k];
        const double r = state[4 + n + k], p = state[rolls + n + k];
        const double lean = b->lean = sin(state[rolls + k]), upright = b->upright = cos(state[rolls + k]);
        if (k > 0) heading -= state[2 + k];
        const double c = b->c = cos(heading), s = b->s = sin(heading);
        double forward, left;
        if (k > 0) {
            const double along = -u->front_hitch, side = u->front_arm * lean;
            const double rate = u->front_arm * upright * p;
            forward = -r * side, left = r * along + rate;
            vx += c * forward - s * left, vy += s * forward + c * left;
            forward = -r * r * along - 2.0 * r * rate, left = -r * r * side - side * p * p;
            bias_x += c * forward - s * left, bias_y += s * forward + c * left;
        }
        b->vx = c * vx + s * vy, b->vy = c * vy - s * vx;
        forward = 2.0 * r * u->cg_arm * upright * p, left = u->cg_arm * lean * (r * r + p * p);
        b->bias_x = bias_x + c * forward - s * left, b->bias_y = bias_y + s * forward + c * left;
        double along = u->rear_hitch, side = -u->rear_arm * lean, rate = -u->rear_arm * upright * p;
        forward = -r * side, left = r * along + rate;
        vx += c * forward - s * left, vy += s * forward + c * left;
        forward = -r * r * along - 2.0 * r * rate, left = -r * r * side - side * p * p;
        bias_x += c * forward - s * left, bias_y += s * forward + c * left;
        const double arm = u->front_arm - u->rear_arm;
        along = u->rear_hitch - u->front_hitch;
        b->through_yaw_x = -c * arm * lean - s * along, b->through_yaw_y = c * along - s * arm * lean;
        b->through_roll_x = -s * arm * upright, b->through_roll_y = c * arm * upright;
    }
}

static void loads(const Vehicle *v, const double *state, double weight, Body *body, double *axle_load)
{
    const double *moment = state + 4 + 4 * v->units;
    double behind = 0.0;
    for (long k = v->units - 1; k >= 0; k--) {
        const Unit *u = &v->unit[k];
        double change = 0.0;
        if (u->support_front != u->support_rear)
            change = ((u->rear_hitch - u->support_rear) * behind + moment[k])
                     / (u->support_front - u->support_rear);
        for (long a = v->first_axle[k]; a < v->first_axle[k + 1]; a++) {
            const Axle *x = &v->axle[a];
            const double shifted = x->front_share * change + x->rear_share * (behind - change);
            axle_load[a] = fmax(weight * x->static_load + shifted, 0.0);
        }
        body[k].carried = weight * u->hitch_load + change;
        behind = change;
    }
}

static double brush(double slip, double stiffness, double limit)
{
    const double linear = stiffness * slip, used = fabs(linear) / (3.0 * limit);
    return used >= 1.0 ? copysign(limit, slip) : linear * (1.0 - used + used * used / 3.0);
}

typedef struct { double slip, grip, vx, vy, along, across; } Wheel;

static void contact(const Axle *x, double forward, double leftward, double c, double s, double held,
                    double deflection, double *slip_rate, double *deflection_rate, Wheel *w)
{
    const double vx = c * forward + s * leftward, vy = c * leftward - s * forward;
    const double rest = fabs(vx) >= 2.5 ? 0.0 : 0.5 + 0.5 * cos(M_PI * vx / 2.5);
    const double sigma = x->relaxation_length;
    if (sigma > 0.0) {
        w->slip = held - 0.1 * rest * vy / sigma;
        *slip_rate = -(vy + fmax(fabs(vx), fabs(vy)) * held) / sigma;
    } else {
        w->slip = -vy / fmax(fabs(vx), 0.1);
        *slip_rate = 0.0;
    }
    const double crawl = clamp(vx, -1.0, 1.0);
    *deflection_rate = -(crawl + fabs(crawl) * deflection) / 0.05;
    w->grip = clamp(deflection - 0.1 * rest * vx / 0.05, -1.0, 1.0);
    w->vx = vx, w->vy = vy;
}

static void force(const Axle *x, double load, double friction, double drive, double resistance,
                  double brake_limit, Wheel *w)
{
    w->along = w->across = 0.0;
    if (load <= 1e-3 || friction <= 0.0) return;
    const double limit = friction * load;
    double across = brush(w->slip, load * fmax(x->stiffness_rate - x->stiffness_slope * load, 0.0), limit);
    const double brake = fmin(resistance, brake_limit * limit);
    double along = drive + brake * w->grip;
    const double used = fabs(along) / limit;
    if (used >= 1.0) along = copysign(limit, along), across = 0.0;
    else across *= sqrt(1.0 - used * used);
    double slide = clamp((brake * fabs(w->grip) / limit - 1.0) / 0.05, 0.0, 1.0);
    if (slide > 0.0) {
        const double square = w->vx * w->vx + w->vy * w->vy;
        slide *= square / (square + 0.01);
        const double per_speed = slide * limit / sqrt(square + 1e-12);
        along = (1.0 - slide) * along - per_speed * w->vx;
        across = (1.0 - slide) * across - per_speed * w->vy;
    }
    w->along = along, w->across = across;
}

static void wheels(const Vehicle *v, const double *state, const double *input, const double *axle_load,
                   Body *body, double *out)
{
    const long n = v->units, rolls = 4 + 2 * n, slips = 4 + 5 * n, carcasses = slips + 2 * v->axles;
    const Scalars *g = v->scalars;
    const double *demands = input + AXLE_STEERING + v->axles;
    double driving = input[7] * fmax(input[1], 0.0);
    if (!isnan(input[2]))
        driving += clamp(g->speed_gain * (input[2] - state[2 + n]), g->lowest_demand, g->highest_demand);
    driving *= g->total_mass;
    const double braking = g->total_mass * fmax(-input[1], 0.0);
    for (long k = 0; k < n; k++) {
        const Unit *u = &v->unit[k];
        Body *b = &body[k];
        const double r = state[4 + n + k], height = u->roll_axis_height;
        const double demand = fmax(demands[k], 0.0), moment = demands[n + k];
        double force_x = 0.0, force_y = 0.0, yaw = 0.0, rolling = 0.0;
        for (long a = v->first_axle[k]; a < v->first_axle[k + 1]; a++) {
            const Axle *x = &v->axle[a];
            const double angle = x->steered * input[0] + input[AXLE_STEERING + a], c = cos(angle), s = sin(angle);
            const double half = x->half_track, load = axle_load[a], drive = 0.5 * x->drive_share * driving;
            const double brake = 0.5 * (x->brake_share * braking + x->unit_brake_share * demand);
            const double one_sided = half > 0.0 ? x->unit_brake_share * fabs(moment) / half : 0.0;
            const double sprung = x->roll_stiffness * state[rolls + k] + x->roll_damping * state[rolls + n + k];
            const double leftward = b->vy + x->position * r;
            Wheel wheel[2];
            for (int i = 0; i < 2; i++) {
                const long place = 2 * a + i;
                contact(x, b->vx - (1 - 2 * i) * half * r, leftward, c, s, state[slips + place],
                        state[carcasses + place], &out[slips + place], &out[carcasses + place], &wheel[i]);
            }
            double shift = 0.0, along = 0.0, across = 0.0, turning = 0.0;
            for (int pass = g->with_roll ? 0 : 1; pass < 2; pass++) {
                if (g->with_roll)
                    shift = clamp(0.5 * (sprung + height * across) / half, -0.5 * load, 0.5 * load);
                along = across = turning = 0.0;
                for (int i = 0; i < 2; i++) {
                    const double side = 1 - 2 * i, own = 0.5 * load - side * shift;
                    double resistance = brake + x->rolling_resistance * own;
                    if (side * moment > 0.0) resistance += one_sided;
                    force(x, own, input[3 + i], drive, resistance, u->brake_limit, &wheel[i]);
                    const double ahead = c * wheel[i].along - s * wheel[i].across;
                    along += ahead;
                    across += s * wheel[i].along + c * wheel[i].across;
                    turning -= side * half * ahead;
                }
            }
            force_x += along, force_y += across, yaw += x->position * across + turning;
            if (g->with_roll) rolling += height * across - 2.0 * shift * half;
        }
        b->force_x = force_x, b->force_y = force_y, b->yaw_moment = yaw, b->roll_moment = rolling;
    }
}

static void hitches(const Vehicle *v, const double *state, Body *body)
{
    const long n = v->units, rolls = 4 + 2 * n;
    for (long k = 0; k + 1 < n; k++) {
        const Unit *u = &v->unit[k];
        const double angle = state[3 + k], rate = state[4 + n + k] - state[5 + n + k];
        double moment = -u->hitch_damping * rate - u->hitch_friction * tanh(rate / 0.01);
        const double past = fabs(angle) - u->max_articulation, side = copysign(1.0, angle);
        if (past > 0.0) moment -= side * fmax(5e6 * past + 2e5 * side * rate, 0.0);
        if (v->scalars->with_roll) {
            const double ahead = state[rolls + k], behind = state[rolls + k + 1], load = body[k + 1].carried;
            const double c = cos(angle), s = sin(angle);
            const double twist_rate = state[rolls + n + k] - state[rolls + n + k + 1] * c + behind * s * rate;
            const double roll = u->hitch_roll_stiffness * (ahead - behind * c)
                                + u->hitch_roll_damping * twist_rate;
            body[k].roll_moment += load * u->rear_arm * body[k].lean - roll;
            body[k + 1].roll_moment += roll * c - load * v->unit[k + 1].front_arm * body[k + 1].lean;
            moment -= roll * behind * s;
        }
        body[k].yaw_moment += moment, body[k + 1].yaw_moment -= moment;
    }
}

static void solve(double m[MOST_ROWS][MOST_ROWS], double *q, long size)
{
    for (long i = 0; i < size; i++) {
        for (long j = 0; j < i; j++) {
            double total = m[i][j];
            for (long k = 0; k < j; k++) total -= m[i][k] * m[j][k];
            m[i][j] = total / m[j][j];
        }
        double total = m[i][i];
        for (long k = 0; k < i; k++) total -= m[i][k] * m[i][k];
        m[i][i] = sqrt(total);
        total = q[i];
        for (long k = 0; k < i; k++) total -= m[i][k] * q[k];
        q[i] = total / m[i][i];
    }
    for (long i = size - 1; i >= 0; i--) {
        double total = q[i];
        for (long k = i + 1; k < size; k++) total -= m[k][i] * q[k];
        q[i] = total / m[i][i];
    }
}

static void accelerations(const Vehicle *v, const double *state, double pull_x, double pull_y, double fall,
                          Body *body, double *q)
{
    const long n = v->units, rolls = 4 + 2 * n;
    const int with_roll = v->scalars->with_roll > 0.0;
    double m[MOST_ROWS][MOST_ROWS];
    double mass = 0.0, force_x = 0.0, force_y = 0.0, inertia_x = 0.0, inertia_y = 0.0;
    for (long k = n - 1; k >= 0; k--) {
        const Unit *u = &v->unit[k];
        const Body *b = &body[k];
        const double own = u->mass, p = state[rolls + n + k], along = -u->front_hitch, front = u->front_arm;
        const double arm = u->cg_arm, lean = b->lean, upright = b->upright, c = b->c, s = b->s;
        const double yx = -c * (front - arm) * lean - s * along, yy = c * along - s * (front - arm) * lean;
        const double gx = -c * front * lean - s * along, gy = c * along - s * front * lean;
        const double own_x = own * (b->bias_x - pull_x), own_y = own * (b->bias_y - pull_y);
        const double rest_x = force_x - inertia_x, rest_y = force_y - inertia_y;
        const double tx = b->through_yaw_x, ty = b->through_yaw_y;
        const double yaw_x = own * yx + mass * tx, yaw_y = own * yy + mass * ty;
        const long yaw = 2 + k, turn = 2 + n + k;
        m[yaw][yaw] = own * (yx * yx + yy * yy) + mass * (tx * tx + ty * ty) + u->yaw_inertia;
        m[yaw][0] = yaw_x, m[yaw][1] = yaw_y;
        q[yaw] = b->yaw_moment + gx * b->force_x + gy * b->force_y - yx * own_x - yy * own_y + tx * rest_x
                 + ty * rest_y;
        for (long j = 0; j < k; j++)
            m[yaw][2 + j] = body[j].through_yaw_x * yaw_x + body[j].through_yaw_y * yaw_y;
        if (with_roll) {
            const double rx = -s * (front - arm) * upright, ry = c * (front - arm) * upright;
            const double px = -s * front * upright, py = c * front * upright;
            const double sx = b->through_roll_x, sy = b->through_roll_y;
            const double roll_x = own * rx + mass * sx, roll_y = own * ry + mass * sy;
            m[turn][turn] = own * (rx * rx + ry * ry) + mass * (sx * sx + sy * sy) + u->roll_inertia
                            + own * arm * arm * lean * lean;
            m[turn][0] = roll_x, m[turn][1] = roll_y;
            m[turn][yaw] = own * (yx * rx + yy * ry) + mass * (tx * sx + ty * sy);
            for (long j = 0; j < k; j++) {
                m[turn][2 + j] = body[j].through_yaw_x * roll_x + body[j].through_yaw_y * roll_y;
                m[turn][2 + n + j] = body[j].through_roll_x * roll_x + body[j].through_roll_y * roll_y;
                m[2 + n + j][yaw] = body[j].through_roll_x * yaw_x + body[j].through_roll_y * yaw_y;
            }
            q[turn] = b->roll_moment + own * arm * lean * (fall - arm * upright * p * p) + px * b->force_x
                      + py * b->force_y - rx * own_x - ry * own_y + sx * rest_x + sy * rest_y;
        }
        mass += own, force_x += b->force_x, force_y += b->force_y, inertia_x += own_x, inertia_y += own_y;
    }
    m[0][0] = m[1][1] = mass, m[1][0] = 0.0;
    q[0] = force_x - inertia_x, q[1] = force_y - inertia_y;
    solve(m, q, with_roll ? 2 + 2 * n : 2 + n);
    double ax = q[0], ay = q[1];
    for (long k = 0; k < n; k++) {
        Body *b = &body[k];
        const double arm = v->unit[k].front_arm - v->unit[k].cg_arm, side = arm * b->lean, c = b->c, s = b->s;
        const double along = -v->unit[k].front_hitch, yaw = q[2 + k], roll = with_roll ? q[2 + n + k] : 0.0;
        b->ax = ax + b->bias_x + (-c * side - s * along) * yaw - s * arm * b->upright * roll;
        b->ay = ay + b->bias_y + (c * along - s * side) * yaw + c * arm * b->upright * roll;
        ax += b->through_yaw_x * yaw + b->through_roll_x * roll;
        ay += b->through_yaw_y * yaw + b->through_roll_y * roll;
    }
    double hitch_x = 0.0, hitch_y = 0.0;
    for (long k = n - 1; k >= 0; k--) {
        hitch_x += v->unit[k].mass * (body[k].ax - pull_x) - body[k].force_x;
        hitch_y += v->unit[k].mass * (body[k].ay - pull_y) - body[k].force_y;
        body[k].hitch_x = hitch_x, body[k].hitch_y = hitch_y;
    }
}

static void rates(const Vehicle *v, const double *state, const double *input, double *out)
{
    const long n = v->units, rolls = 4 + 2 * n;
    const Scalars *g = v->scalars;
    Body body[MOST_UNITS];
    double axle_load[MOST_WHEELS], q[MOST_ROWS];
    const double fall = GRAVITY / sqrt(1.0 + input[5] * input[5] + input[6] * input[6]);
    const double c = cos(state[2]), s = sin(state[2]);
    const double pull_x = -fall * (c * input[5] + s * input[6]), pull_y = -fall * (c * input[6] - s * input[5]);
    chain(v, state, body);
    loads(v, state, fall / GRAVITY, body, axle_load);
    wheels(v, state, input, axle_load, body, out);
    hitches(v, state, body);
    const double drag = -g->drag * body[0].vx * fabs(body[0].vx);
    body[0].force_x += drag;
    for (long k = 0; k < n; k++) {
        const double forward = body[k].force_x, left = body[k].force_y;
        body[k].force_x = body[k].c * forward - body[k].s * left;
        body[k].force_y = body[k].s * forward + body[k].c * left;
    }
    accelerations(v, state, pull_x, pull_y, fall, body, q);
    const double vx = state[2 + n], vy = state[3 + n], r = state[4 + n];
    out[0] = c * vx - s * vy, out[1] = s * vx + c * vy, out[2] = r;
    out[2 + n] = q[0] + r * vy, out[3 + n] = q[1] - r * vx;
    for (long k = 0; k < n; k++) {
        out[4 + n + k] = q[2 + k];
        if (k > 0) out[2 + k] = state[3 + n + k] - state[4 + n + k];
        out[rolls + k] = g->with_roll ? state[rolls + n + k] : 0.0;
        out[rolls + n + k] = g->with_roll ? q[2 + n + k] : 0.0;
        out[rolls + 2 * n + k] = 0.0;
        if (!g->with_load_shift) continue;
        const Unit *u = &v->unit[k];
        const Body *b = &body[k];
        double moment = -u->mass * u->cg_height * (b->c * (b->ax - pull_x) + b->s * (b->ay - pull_y));
        if (k > 0) moment += u->front_height * (b->c * b->hitch_x + b->s * b->hitch_y);
        if (k + 1 < n) moment -= u->rear_height * (b->c * body[k + 1].hitch_x + b->s * body[k + 1].hitch_y);
        if (k == 0) moment += g->drag_height * drag;
        out[rolls + 2 * n + k] = (moment - state[rolls + 2 * n + k]) / g->load_shift_time;
    }
}

/* Take steps of the classical Runge-Kutta method with one input held over all of them. */
void steps(long units, long axles, const Unit *unit, const Axle *axle, const Scalars *scalars,
           const long *first_axle, double *state, const double *input, double dt, long count)
{
    static const double share[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}, reach[4] = {0.5, 0.5, 1.0, 0.0};
    const Vehicle vehicle = {units, axles, unit, axle, scalars, first_axle};
    const long size = 4 + 5 * units + 4 * axles;
    double slope[MOST_STATES], trial[MOST_STATES], total[MOST_STATES];
    for (long step = 0; step < count; step++) {
        memcpy(trial, state, size * sizeof *state);
        memcpy(total, state, size * sizeof *state);
        for (int stage = 0; stage < 4; stage++) {
            rates(&vehicle, trial, input, slope);
            for (long i = 0; i < size; i++) {
                total[i] += dt * share[stage] * slope[i];
                trial[i] = state[i] + dt * reach[stage] * slope[i];
            }
        }
        memcpy(state, total, size * sizeof *state);
    }
}
