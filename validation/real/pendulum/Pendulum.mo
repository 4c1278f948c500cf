package Pendulum "An arm that swings in the field of gravity, and what may act on it besides"
  partial model PartialBearing "What turns the arm besides gravity and viscous friction"
    input Real theta(unit="rad") "Angle of the arm, 0 upright";
    input Real w(unit="rad/s") "Its velocity";
    input Real load(unit="1/s2") "Force along the arm on the bearing over its mass and length, positive outwards";
    output Real a(unit="rad/s2") "Angular acceleration to add";
  end PartialBearing;

  model NoBearing "Nothing"
    extends PartialBearing;
  equation
    a = 0;
  end NoBearing;

  partial model PartialEncoder "What the encoder shows besides the angle"
    input Real theta(unit="rad") "Angle of the arm, 0 upright";
    input Real w(unit="rad/s") "Its velocity";
    output Real e(unit="rad") "Angle to add to the reading";
  end PartialEncoder;

  model NoEncoder "Nothing"
    extends PartialEncoder;
  equation
    e = 0;
  end NoEncoder;

  model Arm "Gravity and viscous friction"
    parameter Real omega2(unit="1/s2", min=40, max=90, nominal=60) = 60 "Weight times arm over inertia";
    parameter Real c(unit="1/s", min=0, max=1, nominal=0.1) = 0.1 "Viscous friction over inertia";
    constant Real inertia(unit="kg.m2") = 1 "No torque was applied, so that the inertia leaves no trace";
    input Real tau(unit="N.m", start=0) "Torque on the arm";
    output Real theta_read(unit="rad") "Angle as the encoder reads it";
    Real theta(unit="rad", start=3.141592653589793, fixed=true) "Angle, 0 upright; at rest it hangs";
    Real w(unit="rad/s", start=0, fixed=true) "Its velocity";
    replaceable NoBearing bearing constrainedby PartialBearing "Torques on the arm";
    replaceable NoEncoder encoder constrainedby PartialEncoder "Reading of the angle";
  equation
    der(theta) = w;
    der(w) = omega2*sin(theta) - c*w + tau/inertia + bearing.a;
    theta_read = theta + encoder.e;
    bearing.theta = theta;
    bearing.w = w;
    bearing.load = w^2 - omega2*cos(theta);
    encoder.theta = theta;
    encoder.w = w;
  end Arm;

  package Effects "What may be missing"
    model DryFriction "Dry friction of the bearing"
      extends PartialBearing;
      parameter Real t_c(unit="rad/s2", min=0, max=2, nominal=0.1) = 0 "Deceleration, 0 = off";
    equation
      a = -t_c*tanh(w/0.02);
      annotation(__HydraulicTestBench(effect="pendulum.dry_friction", slot="bearing"));
    end DryFriction;

    model Drag "Drag of the air with the square of the speed"
      extends PartialBearing;
      parameter Real d(unit="1/rad", min=0, max=0.2, nominal=5e-3) = 0 "Drag over inertia, 0 = off";
    equation
      a = -d*w*abs(w);
      annotation(__HydraulicTestBench(effect="pendulum.drag", slot="bearing"));
    end Drag;

    model LoadFriction "Dry friction that grows with the load of the bearing"
      extends PartialBearing;
      parameter Real mu(unit="1", min=0, max=0.1, nominal=1e-3) = 0 "Friction over load, 0 = off";
    equation
      a = -mu*abs(load)*tanh(w/0.02);
      annotation(__HydraulicTestBench(effect="pendulum.load_friction", slot="bearing"));
    end LoadFriction;

    model Cable "A cable that pulls the arm towards where it hangs"
      extends PartialBearing;
      parameter Real k(unit="1/s2", min=-5, max=5, nominal=0.2) = 0 "Stiffness over inertia, 0 = off";
    equation
      a = -k*(theta - 3.141592653589793);
      annotation(__HydraulicTestBench(effect="pendulum.cable", slot="bearing"));
    end Cable;

    model Bias "A constant torque"
      extends PartialBearing;
      parameter Real a_b(unit="rad/s2", min=-5, max=5, nominal=0.2) = 0 "Acceleration, 0 = off";
    equation
      a = a_b;
      annotation(__HydraulicTestBench(effect="pendulum.bias", slot="bearing"));
    end Bias;

    model Tilt "A centre of mass beside the line that the encoder shows"
      extends PartialBearing;
      parameter Real g_c(unit="rad/s2", min=-5, max=5, nominal=0.2) = 0 "Weight beside the line, 0 = off";
    equation
      a = g_c*cos(theta);
      annotation(__HydraulicTestBench(effect="pendulum.tilt", slot="bearing"));
    end Tilt;

    model EncoderZero "Zero of the encoder"
      extends PartialEncoder;
      parameter Real e_0(unit="rad", min=-0.1, max=0.1, nominal=1e-3) = 0 "Error, 0 = off";
    equation
      e = e_0;
      annotation(__HydraulicTestBench(effect="encoder.zero", slot="encoder"));
    end EncoderZero;

    model EncoderEccentric "Disc of the encoder off its centre"
      extends PartialEncoder;
      parameter Real e_s(unit="rad", min=-0.1, max=0.1, nominal=1e-3) = 0 "Error along the arm, 0 = off";
      parameter Real e_c(unit="rad", min=-0.1, max=0.1, nominal=1e-3) = 0 "Error across the arm, 0 = off";
    equation
      e = e_s*sin(theta) + e_c*(1 + cos(theta));
      annotation(__HydraulicTestBench(effect="encoder.eccentric", slot="encoder"));
    end EncoderEccentric;

    model EncoderLate "Reading that is late by a time that is short beside a swing"
      extends PartialEncoder;
      parameter Real T(unit="s", min=-0.02, max=0.02, nominal=1e-3) = 0 "Delay, 0 = off";
    equation
      e = -T*w;
      annotation(__HydraulicTestBench(effect="encoder.late", slot="encoder"));
    end EncoderLate;

    model Torques "Two torques at once"
      extends PartialBearing;
      replaceable NoBearing first constrainedby PartialBearing;
      replaceable NoBearing second constrainedby PartialBearing;
    equation
      first.theta = theta;
      first.w = w;
      first.load = load;
      second.theta = theta;
      second.w = w;
      second.load = load;
      a = first.a + second.a;
      annotation(__HydraulicTestBench(pair="bearing"));
    end Torques;

    model Readings "Two errors of the reading at once"
      extends PartialEncoder;
      replaceable NoEncoder first constrainedby PartialEncoder;
      replaceable NoEncoder second constrainedby PartialEncoder;
    equation
      first.theta = theta;
      first.w = w;
      second.theta = theta;
      second.w = w;
      e = first.e + second.e;
      annotation(__HydraulicTestBench(pair="encoder"));
    end Readings;
  end Effects;
end Pendulum;
