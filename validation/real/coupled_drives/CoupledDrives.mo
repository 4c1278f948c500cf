package CoupledDrives "Two motors, a flexible belt, a pulley with a pulse counter, and what may act on them besides"
  partial model PartialSignal "A signal on its way: s in, y out"
    input Real s(unit="V") "Signal as the base model has it";
    output Real y(unit="V") "Signal as the rest of the model sees it";
  end PartialSignal;

  model NoSignal "The signal as it is"
    extends PartialSignal;
  equation
    y = s;
  end NoSignal;

  partial model PartialDrive "What drives or brakes the motors besides their voltage"
    input Real m(unit="V") "Speed of the motors, as the counter would show it";
    output Real q(unit="V/s") "Acceleration to add";
  end PartialDrive;

  model NoDrive "Nothing"
    extends PartialDrive;
  equation
    q = 0;
  end NoDrive;

  partial model PartialBelt "What the belt does besides its linear spring and damper"
    input Real m(unit="V") "Speed of the motors";
    input Real y(unit="V") "Speed of the pulley";
    output Real q(unit="V/s2") "To add to the second derivative of the pulley's speed";
  end PartialBelt;

  model NoBelt "Nothing"
    extends PartialBelt;
  equation
    q = 0;
  end NoBelt;

  model Drives "Linear drives, belt and pulley"
    parameter Real K(unit="1", min=0, max=10, nominal=2) = 2 "Speed per volt";
    parameter Real w_0(unit="rad/s", min=4, max=40, nominal=18) = 18 "Resonance of the belt";
    parameter Real zeta(unit="1", min=0, max=2, nominal=0.2) = 0.2 "Its damping";
    parameter Real a(unit="1/s", min=0.2, max=50, nominal=5) = 5 "Pole of the drives";
    parameter Real z_0(unit="V", min=-1, max=3, nominal=0.5) = 0 "Offset of the counter";
    input Real u(unit="V", start=0) "Voltage of both motors";
    output Real z(unit="V") "Reading of the counter";
    Real y(unit="V", start=0, fixed=true) "Speed of the pulley";
    Real y_t(unit="V/s", start=0, fixed=true) "Its derivative";
    Real m(unit="V", start=0, fixed=true) "Speed of the motors";
    replaceable NoSignal amplifier constrainedby PartialSignal "Voltage on its way to the motors";
    replaceable NoDrive drive constrainedby PartialDrive "Motors";
    replaceable NoBelt belt constrainedby PartialBelt "Belt";
    replaceable NoSignal counter constrainedby PartialSignal "Pulse counter";
  equation
    amplifier.s = u;
    der(m) = a*(K*amplifier.y - m) + drive.q;
    der(y) = y_t;
    der(y_t) = w_0^2*(m - y) - 2*zeta*w_0*y_t + belt.q;
    counter.s = y;
    z = counter.y + z_0;
    drive.m = m;
    belt.m = m;
    belt.y = y;
  end Drives;

  package Effects "What may be missing"
    model RisingGain "Gain that rises with the voltage"
      extends PartialSignal;
      parameter Real p(unit="1", min=-0.9, max=3, nominal=0.5) = 0 "Power beyond 1, 0 = off";
    equation
      y = s*(s^2 + 1e-6)^(p/2);
      annotation(__HydraulicTestBench(effect="drives.rising_gain", slot="amplifier"));
    end RisingGain;

    model Deadband "Voltage below which the motors do not turn"
      extends PartialSignal;
      parameter Real u_0(unit="V", min=0, max=1.5, nominal=0.2) = 0 "Half width, 0 = off";
    equation
      y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));
      annotation(__HydraulicTestBench(effect="drives.deadband", slot="amplifier"));
    end Deadband;

    model Clipping "Largest voltage of the amplifier"
      extends PartialSignal;
      parameter Real inverse_u_max(unit="1/V", min=0, max=5, nominal=0.5) = 0 "One over it, 0 = off"
        annotation(__HydraulicTestBench(inverse="u_max", limits="s"));
    equation
      y = s/max(1, abs(s)*inverse_u_max);
      annotation(__HydraulicTestBench(effect="drives.clipping", slot="amplifier"));
    end Clipping;

    model Direction "Gain that differs with the direction"
      extends PartialSignal;
      parameter Real g(unit="1", min=-0.9, max=0.9, nominal=0.1) = 0 "Half of the difference, 0 = off";
    equation
      y = s + g*abs(s);
      annotation(__HydraulicTestBench(effect="drives.direction", slot="amplifier"));
    end Direction;

    model Friction "Dry friction of the motors"
      extends PartialDrive;
      parameter Real q_c(unit="V/s", min=0, max=50, nominal=2) = 0 "Deceleration, 0 = off";
    equation
      q = -q_c*tanh(m/0.05);
      annotation(__HydraulicTestBench(effect="drives.friction", slot="drive"));
    end Friction;

    model Drag "Drag with the square of the speed"
      extends PartialDrive;
      parameter Real d(unit="1/(V.s)", min=0, max=50, nominal=0.5) = 0 "Drag, 0 = off";
    equation
      q = -d*m*abs(m);
      annotation(__HydraulicTestBench(effect="drives.drag", slot="drive"));
    end Drag;

    model Hardening "Belt that grows stiffer as it is pulled"
      extends PartialBelt;
      parameter Real k_3(unit="1/(V2.s2)", min=0, max=2000, nominal=20) = 0 "Cubic stiffness, 0 = off";
    equation
      q = k_3*(m - y)^3;
      annotation(__HydraulicTestBench(effect="belt.hardening", slot="belt"));
    end Hardening;

    model Absolute "The counter is blind to the direction"
      extends PartialSignal;
      parameter Real share(unit="1", min=0, max=1, nominal=0.5) = 0 "Share turned round, 0 = off";
    equation
      y = s + share*(abs(s) - s);
      annotation(__HydraulicTestBench(effect="counter.absolute", slot="counter"));
    end Absolute;

    model Curved "The counter's gain changes with the speed"
      extends PartialSignal;
      parameter Real c(unit="1/V2", min=-0.2, max=0.2, nominal=0.02) = 0 "Cubic part, 0 = off";
    equation
      y = s + c*s^3;
      annotation(__HydraulicTestBench(effect="counter.curved", slot="counter"));
    end Curved;

    model Lag "Time that the counter takes"
      extends PartialSignal(y(start=0, fixed=true));
      parameter Real T(unit="s", min=0, max=1, nominal=0.05) = 0 "Time constant, 0 = off";
    equation
      der(y) = (s - y)/max(T, 1e-3);
      annotation(__HydraulicTestBench(effect="counter.lag", slot="counter", bypass=true));
    end Lag;

    model Voltages "Two changes of the voltage, one behind the other"
      extends PartialSignal;
      replaceable NoSignal first constrainedby PartialSignal;
      replaceable NoSignal second constrainedby PartialSignal;
    equation
      first.s = s;
      second.s = first.y;
      y = second.y;
      annotation(__HydraulicTestBench(pair="amplifier"));
    end Voltages;

    model Brakes "Two things at the motors at once"
      extends PartialDrive;
      replaceable NoDrive first constrainedby PartialDrive;
      replaceable NoDrive second constrainedby PartialDrive;
    equation
      first.m = m;
      second.m = m;
      q = first.q + second.q;
      annotation(__HydraulicTestBench(pair="drive"));
    end Brakes;

    model Readings "Two changes of the reading, one behind the other"
      extends PartialSignal;
      replaceable NoSignal first constrainedby PartialSignal;
      replaceable NoSignal second constrainedby PartialSignal;
    equation
      first.s = s;
      second.s = first.y;
      y = second.y;
      annotation(__HydraulicTestBench(pair="counter"));
    end Readings;
  end Effects;
end CoupledDrives;
