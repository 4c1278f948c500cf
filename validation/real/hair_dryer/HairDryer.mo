package HairDryer "Air that is drawn through a tube over a heated mesh, and what may act on it besides"
  partial model PartialSignal "A signal on its way: s in, y out"
    input Real s(unit="V") "Signal as the base model has it";
    output Real y(unit="V") "Signal as the rest of the model sees it";
  end PartialSignal;

  model NoSignal "The signal as it is"
    extends PartialSignal;
  equation
    y = s;
  end NoSignal;

  partial model PartialHeat "What heats or cools the air besides the linear law"
    input Real y(unit="V") "Temperature of the air, as the thermocouple would show it";
    input Real target(unit="V") "Where the linear law ends";
    output Real q(unit="V") "To add to where it ends";
  end PartialHeat;

  model NoHeat "Nothing"
    extends PartialHeat;
  equation
    q = 0;
  end NoHeat;

  model Dryer "One lag"
    parameter Real K(unit="1", min=0, max=5, nominal=1) = 1 "Gain";
    parameter Real T(unit="s", min=0.02, max=5, nominal=0.5) = 0.5 "Time constant";
    parameter Real y_0(unit="V", min=-5, max=10, nominal=1) = 0 "Reading without heat";
    input Real u(unit="V", start=0) "Voltage of the heater";
    output Real y(unit="V") "Voltage of the thermocouple";
    Real x(unit="V", start=0, fixed=true) "Temperature of the air";
    replaceable NoSignal heater constrainedby PartialSignal "Voltage on its way to the air";
    replaceable NoHeat air constrainedby PartialHeat "Heat of the air";
    replaceable NoSignal thermocouple constrainedby PartialSignal "Thermocouple";
  equation
    heater.s = u;
    T*der(x) = K*heater.y + y_0 - x + air.q;
    air.y = x;
    air.target = K*heater.y + y_0;
    thermocouple.s = x;
    y = thermocouple.y;
  end Dryer;

  package Effects "What may be missing"
    model DeadTime "The way through the tube, as Pade's approximation of order 3"
      extends PartialSignal;
      parameter Real tau(unit="s", min=0, max=2, nominal=0.1) = 0 "Dead time, 0 = off";
    protected
      Real z1(unit="V", start=0, fixed=true) "Equals s at rest";
      Real z2(unit="V", start=0, fixed=true) "Its derivative over 1/tau";
      Real z3(unit="V", start=0, fixed=true) "That of z2";
      Real rate(unit="1/s") "One over the dead time, which is at least 5 ms";
    equation
      rate = 1/max(tau, 5e-3);
      der(z1) = z2*rate;
      der(z2) = z3*rate;
      der(z3) = (120*(s - z1) - 60*z2 - 12*z3)*rate;
      y = 2*z1 + z3/5 - s;
      annotation(__HydraulicTestBench(effect="dryer.dead_time", slot="heater", bypass=true));
    end DeadTime;

    model HeaterLag "Time that the mesh takes to warm up"
      extends PartialSignal(y(start=0, fixed=true));
      parameter Real T_h(unit="s", min=0, max=5, nominal=0.2) = 0 "Time constant, 0 = off";
    equation
      der(y) = (s - y)/max(T_h, 5e-3);
      annotation(__HydraulicTestBench(effect="dryer.heater_lag", slot="heater", bypass=true));
    end HeaterLag;

    model Clipping "Largest voltage of the heater"
      extends PartialSignal;
      parameter Real inverse_u_max(unit="1/V", min=0, max=1, nominal=0.2) = 0 "One over it, 0 = off"
        annotation(__HydraulicTestBench(inverse="u_max", limits="s"));
    equation
      y = s/max(1, abs(s)*inverse_u_max);
      annotation(__HydraulicTestBench(effect="dryer.clipping", slot="heater"));
    end Clipping;

    model Quadratic "Heat with the square of the voltage"
      extends PartialSignal;
      parameter Real g(unit="1/V", min=-1, max=1, nominal=0.1) = 0 "Quadratic part, 0 = off";
    equation
      y = s + g*s*abs(s);
      annotation(__HydraulicTestBench(effect="dryer.quadratic", slot="heater"));
    end Quadratic;

    model Deadband "Voltage below which nothing is heated"
      extends PartialSignal;
      parameter Real u_0(unit="V", min=0, max=5, nominal=0.5) = 0 "Voltage, 0 = off";
    equation
      y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));
      annotation(__HydraulicTestBench(effect="dryer.deadband", slot="heater"));
    end Deadband;

    model Radiation "A loss that grows with the square of the temperature"
      extends PartialHeat;
      parameter Real r(unit="1/V", min=0, max=1, nominal=0.05) = 0 "Loss, 0 = off";
    equation
      q = -r*y*abs(y);
      annotation(__HydraulicTestBench(effect="dryer.radiation", slot="air"));
    end Radiation;

    model Direction "Air that warms faster than it cools"
      extends PartialHeat;
      parameter Real g(unit="1", min=-0.9, max=0.9, nominal=0.1) = 0 "Half of the difference, 0 = off";
    equation
      q = g*abs(target - y);
      annotation(__HydraulicTestBench(effect="dryer.direction", slot="air"));
    end Direction;

    model Friction "A force that holds the temperature where it is, as dry friction would"
      extends PartialHeat;
      parameter Real q_c(unit="V", min=0, max=2, nominal=0.1) = 0 "Difference that it holds, 0 = off";
    equation
      q = -q_c*tanh((target - y)/0.05);
      annotation(__HydraulicTestBench(effect="dryer.friction", slot="air"));
    end Friction;

    model Lag "Time that the thermocouple takes"
      extends PartialSignal(y(start=0, fixed=true));
      parameter Real T_2(unit="s", min=0, max=5, nominal=0.2) = 0 "Time constant, 0 = off";
    equation
      der(y) = (s - y)/max(T_2, 5e-3);
      annotation(__HydraulicTestBench(effect="thermocouple.lag", slot="thermocouple", bypass=true));
    end Lag;

    model Curved "Gain that changes with the temperature"
      extends PartialSignal;
      parameter Real c(unit="1/V", min=-0.5, max=0.5, nominal=0.02) = 0 "Quadratic part, 0 = off";
    equation
      y = s + c*s*abs(s);
      annotation(__HydraulicTestBench(effect="thermocouple.curved", slot="thermocouple"));
    end Curved;

    model Voltages "Two changes of the voltage, one behind the other"
      extends PartialSignal;
      replaceable NoSignal first constrainedby PartialSignal;
      replaceable NoSignal second constrainedby PartialSignal;
    equation
      first.s = s;
      second.s = first.y;
      y = second.y;
      annotation(__HydraulicTestBench(pair="heater"));
    end Voltages;

    model Heats "Two heats at once"
      extends PartialHeat;
      replaceable NoHeat first constrainedby PartialHeat;
      replaceable NoHeat second constrainedby PartialHeat;
    equation
      first.y = y;
      first.target = target;
      second.y = y;
      second.target = target;
      q = first.q + second.q;
      annotation(__HydraulicTestBench(pair="air"));
    end Heats;

    model Readings "Two changes of the reading, one behind the other"
      extends PartialSignal;
      replaceable NoSignal first constrainedby PartialSignal;
      replaceable NoSignal second constrainedby PartialSignal;
    equation
      first.s = s;
      second.s = first.y;
      y = second.y;
      annotation(__HydraulicTestBench(pair="thermocouple"));
    end Readings;
  end Effects;
end HairDryer;
