package Tank
  partial model PartialHeat "Heat into the oil beside that of pump and wall"
    input Real T(unit="K") "Temperature of the oil";
    input Real T_air(unit="K") "Temperature around the tank";
    output Real Q(unit="W") "Heat, positive into the oil";
  end PartialHeat;
  model NoHeat "Nothing"
    extends PartialHeat;
  equation
    Q = 0;
  end NoHeat;
  model Cooler "Cooler with a thermostat"
    extends PartialHeat;
    parameter Real G_c(unit="W/K", min=0, max=500, nominal=50) = 0 "Conductance above the set point, 0 = off";
    parameter Real T_set(unit="K", min=300, max=350, nominal=320) = 320 "Set point of the thermostat";
  equation
    Q = -G_c*(T - T_air)*(1 + tanh((T - T_set)/0.5))/2;
    annotation(__HydraulicTestBench(effect="tank.cooler", slot="extra"));
  end Cooler;
  model Radiation "Radiation of the hot wall"
    extends PartialHeat;
    parameter Real k_r(unit="W/K4", min=0, max=1e-6, nominal=1e-8) = 0 "Area times emissivity and Stefan-Boltzmann, 0 = off";
  equation
    Q = -k_r*(T^4 - T_air^4);
    annotation(__HydraulicTestBench(effect="tank.radiation", slot="extra"));
  end Radiation;
  model Oil "Oil that a pump heats"
    parameter Real C(unit="J/K", min=1e3, max=1e5, nominal=1e4) = 1e4 "Heat capacity";
    parameter Real G(unit="W/K", min=1, max=200, nominal=20) = 20 "Conductance of the wall";
    input Real P(unit="W", start=0) "Heat of the pump";
    input Real T_air(unit="K", start=293.15);
    output Real T(unit="K", start=293.15, fixed=true);
    replaceable NoHeat extra constrainedby PartialHeat;
  equation
    extra.T = T;
    extra.T_air = T_air;
    C*der(T) = P - G*(T - T_air) + extra.Q;
  end Oil;
end Tank;
