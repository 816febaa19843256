within ;
package @name "Gearbox of @file"
  import Modelica.Units.SI;
  constant Real ratio=@ratio "Speed of flange_b over that of flange_a";
  constant Real oilTemperatures[:]=@oil_temperature "K";
  constant Real torques[:]=@torque "At flange_b, above 0 against the motion, N.m";
  constant Real speeds[:]=@speed "Of flange_a, rad/s";
  constant Real drags[:, :, :]=@drag "Loss as a torque at flange_a: temperature, torque, speed, N.m";
  constant Real twists[:]=@twist "At flange_b with flange_a held, rad";
  constant Real twistTorques[:]=@twist_torque "Torque at these twists, N.m";
  constant Real errorOrders[:]=@order "Cycles of the transmission error per turn of flange_a";
  constant Real errorAmplitudes[:]=@amplitude "At flange_b, rad";
  constant Real errorPhases[:]=@phase "rad";
  constant Real lossTable[:, 5]=@loss_table
    "LossyGear at @temperature: |w_a|, eta_mf1, eta_mf2, |tau_bf1|, |tau_bf2|";

  function intervalOf "Number of the interval of an axis that holds a value"
    input Real axis[:];
    input Real value;
    output Integer number;
  algorithm
    number := 1;
    while number < size(axis, 1) - 1 and value >= axis[number + 1] loop
      number := number + 1;
    end while;
  end intervalOf;

  function drag "Loss as a torque at flange_a: linear between the points, constant beyond the ends"
    input SI.Temperature oilTemperature;
    input SI.Torque torque "At flange_b, above 0 against the motion";
    input SI.AngularVelocity speed "Of flange_a";
    output SI.Torque value;
  protected
    Integer t;
    Integer m;
    Integer n;
    Real a;
    Real b;
    Real c;
  algorithm
    t := intervalOf(oilTemperatures, oilTemperature);
    m := intervalOf(torques, torque);
    n := intervalOf(speeds, speed);
    a := share(oilTemperatures, t, oilTemperature);
    b := share(torques, m, torque);
    c := share(speeds, n, speed);
    value := 0;
    for i in 0:1 loop
      for j in 0:1 loop
        for k in 0:1 loop
          value := value + (if i == 1 then a else 1 - a)*(if j == 1 then b else 1 - b)
            *(if k == 1 then c else 1 - c)*drags[min(t + i, size(oilTemperatures, 1)), min(m + j,
            size(torques, 1)), min(n + k, size(speeds, 1))];
        end for;
      end for;
    end for;
  end drag;

  function share "Share of an interval below a value, held at the ends"
    input Real axis[:];
    input Integer number;
    input Real value;
    output Real part;
  algorithm
    part := if size(axis, 1) == 1 then 0 else max(0, min(1, (value - axis[number])/(axis[min(number +
      1, size(axis, 1))] - axis[number])));
  end share;

  function elasticTorque "Torque over twist, with backlash; its last slope goes on"
    input SI.Angle twist;
    output SI.Torque torque;
  protected
    Integer n;
  algorithm
    n := intervalOf(twists, twist);
    torque := twistTorques[n] + (twist - twists[n])*(twistTorques[n + 1] - twistTorques[n])/(twists[n
       + 1] - twists[n]);
  end elasticTorque;

  model Gearbox "Losses, inertia, elasticity with backlash, transmission error, heat into the oil"
    Modelica.Mechanics.Rotational.Interfaces.Flange_a flange_a "Input";
    Modelica.Mechanics.Rotational.Interfaces.Flange_b flange_b "Output";
    Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a heatPort "Oil";
    parameter SI.Inertia J=@inertia "Of the gearbox, at flange_a";
    parameter SI.RotationalDampingConstant d=@damping "At flange_b, where teeth touch";
    parameter SI.Angle backlash=@backlash "At flange_b";
    parameter SI.AngularVelocity w_small=@small "Below it friction is smoothed through standstill";
    parameter Boolean withError=true "Transmission error";
    SI.AngularVelocity w_a "Speed of the input";
    SI.AngularVelocity w_b "Speed of the output";
    SI.Angle error "Transmission error at flange_b";
    SI.Angle twist;
    SI.AngularVelocity twistRate;
    SI.Torque tau_b "Torque of the gearbox on flange_b";
    SI.Torque tau_loss "At flange_a, in the direction of motion";
    Real direction "Of motion, smoothed";
    Real touching "Share of the damping: 0 in backlash";
    SI.Power lossPower;
  equation
    w_a = der(flange_a.phi);
    w_b = der(flange_b.phi);
    direction = tanh(w_a/w_small);
    error = if withError then sign(ratio)*sum({errorAmplitudes[i]*cos(errorOrders[i]*flange_a.phi +
      errorPhases[i]) for i in 1:size(errorOrders, 1)}) else 0;
    twist = ratio*flange_a.phi - flange_b.phi - error;
    twistRate = ratio*w_a - w_b + (if withError then sign(ratio)*w_a*sum({errorAmplitudes[i]*
      errorOrders[i]*sin(errorOrders[i]*flange_a.phi + errorPhases[i]) for i in 1:size(errorOrders, 1)})
       else 0);
    touching = if backlash > 0 then 0.5*(1 + tanh(20*(abs(twist)/(0.5*backlash) - 1.1))) else 1;
    tau_b = elasticTorque(twist) + touching*d*twistRate;
    tau_loss = drag(heatPort.T, sign(ratio)*tau_b*direction, w_a)*direction;
    J*der(w_a) = flange_a.tau - ratio*tau_b - tau_loss;
    flange_b.tau = -tau_b;
    lossPower = tau_loss*w_a + touching*d*twistRate^2;
    heatPort.Q_flow = -lossPower;
  end Gearbox;

  model Lossy "The gear of the standard library, stuck at standstill; losses at @temperature"
    extends Modelica.Mechanics.Rotational.Components.LossyGear(ratio=1/@name.ratio, lossTable=
      @name.lossTable);
  end Lossy;

  model Example "A motor of constant torque turns a fan from rest"
    Gearbox gearbox;
    Modelica.Mechanics.Rotational.Sources.ConstantTorque motor(tau_constant=@motor);
    Modelica.Mechanics.Rotational.Components.Inertia load(J=10*gearbox.J/ratio^2, phi(fixed=true,
      start=0), w(fixed=true, start=0));
    Modelica.Mechanics.Rotational.Sources.QuadraticSpeedDependentTorque fan(tau_nominal=-@fan,
      TorqueDirection=false, w_nominal=@fan_speed);
    Modelica.Thermal.HeatTransfer.Sources.FixedTemperature oil(T=@oil);
  equation
    connect(motor.flange, gearbox.flange_a);
    connect(gearbox.flange_b, load.flange_a);
    connect(load.flange_b, fan.flange);
    connect(oil.port, gearbox.heatPort);
    annotation(experiment(StopTime=@duration));
  end Example;
end @name;
