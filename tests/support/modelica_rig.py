"""The connectors that an exported Modelica package takes from the standard library, and a rig with them."""

#: Written for tests: names and meaning of the standard library, nothing else of it.
CONNECTORS = """
package Modelica
  package Units
    package SI
      type Angle = Real(unit="rad");
      type AngularVelocity = Real(unit="rad/s");
      type Torque = Real(unit="N.m");
      type Temperature = Real(unit="K");
      type Inertia = Real(unit="kg.m2");
      type RotationalDampingConstant = Real(unit="N.m.s/rad");
      type Power = Real(unit="W");
    end SI;
  end Units;
  package Mechanics
    package Rotational
      package Interfaces
        connector Flange_a
          Real phi;
          flow Real tau;
        end Flange_a;
        connector Flange_b
          Real phi;
          flow Real tau;
        end Flange_b;
      end Interfaces;
    end Rotational;
  end Mechanics;
  package Thermal
    package HeatTransfer
      package Interfaces
        connector HeatPort_a
          Real T;
          flow Real Q_flow;
        end HeatPort_a;
      end Interfaces;
    end HeatTransfer;
  end Thermal;
end Modelica;
"""

#: A torque turns a load through the gearbox from rest, against a torque.
RIG = """
model Push
  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange;
  parameter Real tau=1;
equation
  flange.tau = -tau;
end Push;
model Mass
  Modelica.Mechanics.Rotational.Interfaces.Flange_a flange;
  parameter Real J=1;
  Real phi(start=0, fixed=true);
  Real w(start=0, fixed=true);
equation
  flange.phi = phi;
  w = der(phi);
  J*der(w) = flange.tau;
end Mass;
model Bath
  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port;
  parameter Real T=330;
  Real heat(start=0, fixed=true);
equation
  port.T = T;
  der(heat) = port.Q_flow;
end Bath;
model Rig
  reducer.Gearbox gearbox;
  Push drive(tau=36);
  Push brake(tau=300);
  Mass load(J=20);
  Bath oil;
equation
  connect(drive.flange, gearbox.flange_a);
  connect(gearbox.flange_b, load.flange);
  connect(brake.flange, load.flange);
  connect(oil.port, gearbox.heatPort);
end Rig;
"""
