% The gear pair of numpy_model.py in Octave: octave-cli gear_pair.m FOLDER reads FOLDER/case.mat and writes
% FOLDER/found.mat: of given states the derivatives (rates), otherwise what ode15s makes of the case (xi at the
% samples, seconds of the integration).
1;

function dy = gear_pair(phase, y, k, p, channel, stiffness, first, last)
  cells = rows(channel);
  place = min(max((phase - first) / (last - first) * cells, 0), cells - 1e-9);
  cell = floor(place);
  u = place - cell;
  c = reshape(channel(cell + 1, :, :, :), [4, 7, size(channel, 4)]);
  value = squeeze(c(1, :, :) + u * (c(2, :, :) + u * (c(3, :, :) + u * c(4, :, :))));
  slope = squeeze(c(2, :, :) + u * (2 * c(3, :, :) + 3 * u * c(4, :, :)));
  value = reshape(value, 7, []);
  slope = reshape(slope, 7, []) * (cells / (last - first) / p.pitch_angle);
  pairs = columns(value);
  s = reshape(stiffness(cell + 1, :, :, :), [4, pairs * pairs]);
  matrix = reshape(s(1, :) + u * (s(2, :) + u * (s(3, :) + u * s(4, :))), pairs, pairs);
  cosine = value(1, :)'; r = value(2, :)'; radius = value(3, :)'; speed = value(4, :)';
  compliance = value(5, :)'; gap = value(6, :)'; sine = value(7, :)';

  towards = y(1) - y(3) - p.gear_radius * y(5); across = y(2) - y(4);
  towards_rate = y(6) - y(8) - p.gear_radius * y(10); across_rate = y(7) - y(9);
  approach = towards * cosine + across * sine - gap;
  moved = (towards * slope(1, :)' + across * slope(7, :)' - slope(6, :)') * p.omega;
  approach_rate = towards_rate * cosine + across_rate * sine + moved;
  normal = max(matrix * approach, 0) + p.mesh_damping * approach_rate ./ sqrt(compliance);
  normal = max(normal, 0);
  u_p = p.omega * speed;
  slip = p.omega * (1 + p.w) * r;
  u_g = u_p - slip;
  if p.dynamic
    slip = slip + towards_rate * sine - across_rate * cosine + y(10) * r;
  end
  sliding = abs(slip);

  load = max(normal / p.face_width, 1);
  modulus = p.effective_modulus;
  W = load ./ (modulus * radius);
  U = p.inlet_viscosity * 0.5 * abs(u_p + u_g) ./ (modulus * radius);
  inner = p.asperity * radius.^-6.015 .* W.^0.485 .* U.^-3.741;
  share = min(5e-5 * W.^-0.408 .* U.^-0.088 * p.material^0.103 .* log1p(inner), 1);
  film = 2.691 * W.^-0.135 .* U.^0.705 * p.material^0.556 .* radius;
  film = film .* (1 + p.rough * radius.^-1.222 .* W.^-0.229 .* U.^-0.748);
  half = sqrt(8 * load .* radius / (pi * modulus));
  pressure = load ./ (2 * half);
  limit = p.limiting_shear_coefficient * pressure .* (1 - p.limiting_share * share);
  flux = sliding .* pressure .* (p.asperity_friction * share + p.limiting_shear_coefficient * (1 - share));
  conducted = p.pinion_conductivity * sqrt(1 + half .* abs(u_p) * p.pinion_heat_capacity / (2 * p.pinion_conductivity)) ...
    + p.gear_conductivity * sqrt(1 + half .* abs(u_g) * p.gear_heat_capacity / (2 * p.gear_conductivity));
  rise = 2 * half .* flux ./ (sqrt(pi) * conducted);
  fluid = p.viscosity_pressure_factor * pressure .* (1 - share);
  exponent = (log(p.inlet_viscosity) + 9.67) * ((1 + 5.1e-9 * fluid).^p.viscosity_pressure_index - 1);
  viscosity = p.inlet_viscosity * exp(exponent - p.temperature_viscosity * rise);
  newtonian = min(viscosity .* sliding ./ (limit .* film), 600);
  coefficient = p.asperity_friction * share - limit ./ pressure .* expm1(-newtonian);

  turned = min(max(slip / p.reversed_at, -1), 1);
  tangential = coefficient .* normal .* 0.5 .* turned .* (3 - turned.^2);
  force_x = -sum(normal .* cosine + tangential .* sine);
  force_y = sum(tangential .* cosine - normal .* sine);
  moment = sum(normal .* p.gear_radius .* cosine + tangential .* (p.gear_radius * sine - r));
  forces = [force_x; force_y; -force_x; -force_y] - p.springs .* y(1:4) - p.dampers .* y(6:9);
  dy = p.rate * [y(6:10); forces ./ p.masses; (moment - p.load_torque) / p.gear_inertia];
end

folder = argv(){end};
load(fullfile(folder, "case.mat"));
if exist("states", "var")
  rates = zeros(size(states));
  for i = 1:columns(states)
    k = segment(i);
    rates(:, i) = gear_pair(phase(i), states(:, i), k, p, channel{k}, stiffness{k}, boundary(k), boundary(k + 1));
  end
  save("-v7", fullfile(folder, "found.mat"), "rates");
  exit(0);
end
at = (0:samples - 1) / samples;
y = y0;
xi = [];
tic;
begun = cputime;
for cycle = 1:cycles
  for k = 1:numel(boundary) - 1
    first = boundary(k); last = boundary(k + 1);
    wanted = at(at >= first & at < last);
    times = unique([first, wanted, last]);
    function_here = @(t, y) gear_pair(t, y, k, p, channel{k}, stiffness{k}, first, last);
    options = odeset("RelTol", rtol, "AbsTol", atol);
    [t, states] = ode15s(function_here, times, y, options);
    xi = [xi; -p.gear_radius * states(ismember(t, wanted), 5)];
    y = states(end, :)';
  end
end
seconds = min(toc, cputime - begun);
save("-v7", fullfile(folder, "found.mat"), "xi", "seconds");
