package MotorGenerator "A switched DC motor that turns a generator, and what may act on them besides"
  partial model PartialShaft "What turns or brakes the shaft besides the motor"
    input Real w(unit="1") "Speed of the shaft, in the unit of the log";
    output Real a(unit="1/s") "Change of speed per second to add";
  end PartialShaft;

  model NoShaft "Nothing"
    extends PartialShaft;
  equation
    a = 0;
  end NoShaft;

  partial model PartialCircuit "What the motor's circuit does besides its linear law"
    input Real u(unit="V") "Voltage of the motor";
    input Real w(unit="1") "Speed of the shaft";
    input Real drive(unit="1/s") "Change of speed per second as the linear law has it";
    output Real a(unit="1/s") "Change of speed per second to add";
  end PartialCircuit;

  model NoCircuit "Nothing"
    extends PartialCircuit;
  equation
    a = 0;
  end NoCircuit;

  partial model PartialSensor "The speed on its way to the log: s in, y out"
    input Real s(unit="1") "Signal as the base model has it";
    output Real y(unit="1") "Signal that is logged";
  end PartialSensor;

  model NoSensor "The signal as it is"
    extends PartialSensor;
  equation
    y = s;
  end NoSensor;

  model Motor "Linear motor with a lagging speed signal"
    parameter Real K(unit="1/V", min=100, max=6000, nominal=1500) = 1500 "Speed per volt";
    parameter Real T(unit="s", min=0.02, max=20, nominal=1) = 1 "Mechanical time constant";
    parameter Real T_f(unit="s", min=0.002, max=2, nominal=0.2) = 0.2 "Lag of speed signal and armature";
    parameter Real n_0(unit="1", min=-150, max=-140, nominal=1) = -143.7 "Reading at rest";
    input Real u(unit="V", start=0) "Voltage of the motor";
    output Real n(unit="1") "Speed as logged";
    Real w(unit="1", start=0, fixed=true) "Speed of the shaft";
    Real y(unit="1", start=0, fixed=true) "Speed signal above rest";
    replaceable NoShaft shaft constrainedby PartialShaft "Loads on the shaft";
    replaceable NoCircuit circuit constrainedby PartialCircuit "Electric circuit";
    replaceable NoSensor sensor constrainedby PartialSensor "Speed sensor";
  equation
    circuit.u = u;
    circuit.w = w;
    circuit.drive = (K*u - w)/T;
    der(w) = circuit.drive + circuit.a + shaft.a;
    T_f*der(y) = w - y;
    sensor.s = y;
    n = sensor.y + n_0;
    shaft.w = w;
  end Motor;

  package Effects "What may be missing"
    model OpenCircuit "At no voltage the circuit is open and does not brake"
      extends PartialCircuit;
      parameter Real share(unit="1", min=0, max=1, nominal=0.5) = 0 "Share of the brake that is gone then, 0 = off";
      constant Real u_on(unit="V") = 5 "Voltage that the motor is switched to";
    equation
      a = -share*drive*(1 - u/u_on);
      annotation(__HydraulicTestBench(effect="generator.open_circuit", slot="circuit"));
    end OpenCircuit;

    model Saturation "A brake that grows with the square of the speed under voltage"
      extends PartialCircuit;
      parameter Real c(unit="1/s", min=0, max=0.01, nominal=1e-4) = 0 "Brake, 0 = off";
      constant Real u_on(unit="V") = 5 "Voltage that the motor is switched to";
    equation
      a = -c*u/u_on*w*abs(w);
      annotation(__HydraulicTestBench(effect="generator.saturation", slot="circuit"));
    end Saturation;

    model Deadband "A voltage drop at the brushes, towards no current"
      extends PartialCircuit;
      parameter Real a_0(unit="1/s", min=0, max=5000, nominal=200) = 0 "Change of speed that it costs, 0 = off";
    equation
      a = -a_0*tanh(drive/100);
      annotation(__HydraulicTestBench(effect="generator.brush_drop", slot="circuit"));
    end Deadband;

    model DryFriction "Dry friction of shaft and brushes"
      extends PartialShaft;
      parameter Real F_c(unit="1/s", min=0, max=5000, nominal=500) = 0 "Deceleration, 0 = off";
    equation
      a = -F_c*tanh(w/20);
      annotation(__HydraulicTestBench(effect="generator.friction", slot="shaft"));
    end DryFriction;

    model Drag "Drag of the air with the square of the speed"
      extends PartialShaft;
      parameter Real d(unit="1/s", min=0, max=0.01, nominal=1e-4) = 0 "Drag, 0 = off";
    equation
      a = -d*w*abs(w);
      annotation(__HydraulicTestBench(effect="generator.drag", slot="shaft"));
    end Drag;

    model Bias "A constant torque"
      extends PartialShaft;
      parameter Real a_b(unit="1/s", min=-2000, max=2000, nominal=200) = 0 "Change of speed per second, 0 = off";
    equation
      a = a_b;
      annotation(__HydraulicTestBench(effect="generator.bias", slot="shaft"));
    end Bias;

    model Curved "The sensor's gain changes with the speed"
      extends PartialSensor;
      parameter Real c(unit="1", min=-5e-5, max=5e-5, nominal=5e-6) = 0 "Quadratic part, 0 = off";
    equation
      y = s + c*s*abs(s);
      annotation(__HydraulicTestBench(effect="speed.curved", slot="sensor"));
    end Curved;

    model Clipping "Largest speed that the sensor shows"
      extends PartialSensor;
      parameter Real inverse_n_max(unit="1", min=0, max=1e-3, nominal=2e-4) = 0 "One over it, 0 = off"
        annotation(__HydraulicTestBench(inverse="n_max", limits="s"));
    equation
      y = s/max(1, abs(s)*inverse_n_max);
      annotation(__HydraulicTestBench(effect="speed.clipping", slot="sensor"));
    end Clipping;

    model Lag "A second lag of the speed signal"
      extends PartialSensor(y(start=0, fixed=true));
      parameter Real T_2(unit="s", min=0, max=2, nominal=0.1) = 0 "Time constant, 0 = off";
    equation
      der(y) = (s - y)/max(T_2, 2e-3);
      annotation(__HydraulicTestBench(effect="speed.lag", slot="sensor", bypass=true));
    end Lag;

    model Loads "Two loads on the shaft at once"
      extends PartialShaft;
      replaceable NoShaft first constrainedby PartialShaft;
      replaceable NoShaft second constrainedby PartialShaft;
    equation
      first.w = w;
      second.w = w;
      a = first.a + second.a;
      annotation(__HydraulicTestBench(pair="shaft"));
    end Loads;

    model Circuits "Two changes of the circuit at once"
      extends PartialCircuit;
      replaceable NoCircuit first constrainedby PartialCircuit;
      replaceable NoCircuit second constrainedby PartialCircuit;
    equation
      first.u = u;
      first.w = w;
      first.drive = drive;
      second.u = u;
      second.w = w;
      second.drive = drive;
      a = first.a + second.a;
      annotation(__HydraulicTestBench(pair="circuit"));
    end Circuits;

    model Readings "Two changes of the reading, one behind the other"
      extends PartialSensor;
      replaceable NoSensor first constrainedby PartialSensor;
      replaceable NoSensor second constrainedby PartialSensor;
    equation
      first.s = s;
      second.s = first.y;
      y = second.y;
      annotation(__HydraulicTestBench(pair="sensor"));
    end Readings;
  end Effects;
end MotorGenerator;
